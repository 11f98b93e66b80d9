//! Log of finished presses, which stores new presses safely.

use taceva_core::{Frame, PressOutcome, Sample, SinkError};

use super::depth_zero::DepthZero;
use super::force_zero::ForceZero;
use super::reference_touch::SessionRecord;
use crate::content_id::ContentId;

/// Record of finished presses that remains after the process ends.
pub trait PressLog {
    /// True if `press` was appended, in this run or an earlier run.
    fn is_finished(&self, press: ContentId) -> bool;

    /// Appends a complete press, and returns when it is safely stored. After an interruption, the log contains all of the press or nothing.
    ///
    /// # Errors
    /// Any failure to store the press safely. The run then stops, and the press counts as not finished.
    fn append(&mut self, record: &PressRecord) -> Result<(), SinkError>;

    /// Stores a frame of the untouched gel in the reference light, before the first press with frames of each unit. A repeated press repeats it.
    ///
    /// # Errors
    /// Any failure to store the frame safely. The run then stops.
    fn untouched(&mut self, frame: &Frame) -> Result<(), SinkError>;

    /// Stores the zero of the transducer before and after a discarded attempt at `press`, during which the zero changed too far. The zero of a
    /// finished press is in [`PressRecord::force_zero`].
    ///
    /// # Errors
    /// Any failure to store the zero. The run then stops.
    fn zero_step(&mut self, press: ContentId, zero: &ForceZero) -> Result<(), SinkError> {
        let _ = (press, zero);
        Ok(())
    }

    /// Stores the record of a session's start, before its first press. Only runs with a rig file have sessions.
    ///
    /// # Errors
    /// Any failure to store the record safely. The run then stops.
    fn session(&mut self, record: &SessionRecord) -> Result<(), SinkError> {
        let _ = record;
        Ok(())
    }
}

/// A finished press.
#[derive(Clone, Debug, PartialEq)]
pub struct PressRecord {
    /// Id of the press.
    pub press: ContentId,
    /// Outcome of the press.
    pub outcome: PressOutcome,
    /// Height relative to which depths are measured; `None` for a press without waypoints or without contact.
    pub zero: Option<DepthZero>,
    /// Zero of the transducer before and after the press; `None` if the transducer sets its own zero.
    pub force_zero: Option<ForceZero>,
    /// Samples in order, named `<press>/<number>` by waypoint or frame. Waypoints that a limited press skipped have no sample.
    ///
    /// The truth of a sample has the channels of the plan, in that order. `Pz` is the depth below the depth zero of the press. `surface_z` is the
    /// height of the touched surface in the sensor frame, positive into the gel. A press gives one of these two. A sample that a limit stopped before
    /// its waypoint names the limit and has no `depth_step`.
    pub samples: Vec<Sample>,
}
