//! Events of a run, for display during the run.

use taceva_core::{Millimetre, PressOutcome, Specimen};

use super::force_zero::ZeroStep;
use super::halt_reason::Trip;
use crate::content_id::ContentId;

/// An event of a run.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Event {
    /// The run begins.
    Started {
        /// Number of presses of this unit.
        presses: usize,
        /// Number of presses that earlier runs finished.
        finished: usize,
    },
    /// A specimen was mounted.
    Mounted(Specimen),
    /// The light was set.
    Lit(String),
    /// A press is left for another run because the operator skipped a manual step that the press needs.
    Skipped(ContentId),
    /// A press begins.
    Approaching {
        /// Id of the press.
        press: ContentId,
        /// Number of the press among the presses of this unit, counted from 1.
        number: usize,
    },
    /// The gel was touched.
    Contact {
        /// Height of the contact along z of the sensor frame, in mm, positive into the gel.
        height: Millimetre,
    },
    /// A frame was lost, damaged or stamped by another clock, and is captured again. A frame captured too early causes no such event.
    FrameRetried,
    /// A frame was bit-equal to the previous frame although the force changed. Its press is aborted.
    FrameFrozen,
    /// The zero of the transducer changed too far during a press. The press is discarded.
    ZeroStepped(ZeroStep),
    /// A sample was taken.
    Sampled {
        /// Number of the sample in the press, counted from 0.
        number: usize,
    },
    /// The supervisor halted the robot.
    Halted(Trip),
    /// The force was lost while a question to the operator was open. Contains the cause and the remedy.
    ForceLost(String),
    /// The tip left the gel after a halt.
    Retracted,
    /// The enabling switch is not held. Nothing moves until the operator holds it.
    Unheld,
    /// Stale signals, a changed zero of the force or a released enabling switch ended a press early. The press is repeated from its start.
    Redone {
        /// Id of the press.
        press: ContentId,
        /// Number of interruptions of this press.
        times: u32,
    },
    /// A press is finished and safely stored.
    Finished {
        /// Id of the press.
        press: ContentId,
        /// Outcome of the press.
        outcome: PressOutcome,
    },
    /// A rehearsal visited a place in the air.
    Rehearsed(ContentId),
}
