//! What a run writes to: it learns what is finished, and waits until what it hands over is durable.

use taceva_core::{Frame, PressOutcome, Sample, SinkError};

use super::reference_touch::SessionRecord;
use crate::content_id::ContentId;

/// A record of finished presses that outlives the process.
pub trait PressLog {
    /// Whether `press` was appended, in this run or an earlier one.
    fn is_finished(&self, press: ContentId) -> bool;

    /// Takes a whole press and returns once it is durable: all of it, or, after an interruption, none.
    ///
    /// # Errors
    /// Whatever keeps it from being durable; the run stops, and the press counts as not made.
    fn append(&mut self, record: &PressRecord) -> Result<(), SinkError>;

    /// Takes what the sensor sees while nothing touches it, in the light that others are compared with. It comes before the first press with
    /// pictures of each unit, and again whenever that press is made again.
    ///
    /// # Errors
    /// Whatever keeps it from being durable; the run stops.
    fn untouched(&mut self, frame: &Frame) -> Result<(), SinkError>;

    /// Takes how a session on the rig of a rig file began, before its first press.
    ///
    /// # Errors
    /// Whatever keeps it from being durable; the run stops.
    fn session(&mut self, record: &SessionRecord) -> Result<(), SinkError> {
        let _ = record;
        Ok(())
    }
}

/// A finished press.
#[derive(Clone, Debug, PartialEq)]
pub struct PressRecord {
    /// Its name.
    pub press: ContentId,
    /// How it ended.
    pub outcome: PressOutcome,
    /// Its samples in order, called `<press>/<number>`, where the number is that of the waypoint or picture in the press: those that a
    /// limited press left out are not there.
    ///
    /// Truth is in the channels of the plan, in its order. `Pz` is the depth from the first contact, `surface_z` the height in the
    /// sensor's frame at which a surface was felt, positive into the gel; each is absent where the other is meant. Those that a limit kept
    /// from their waypoint name it and have no `depth_step`.
    pub samples: Vec<Sample>,
}
