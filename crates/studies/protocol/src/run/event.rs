//! What happens in a run, as it happens, for whoever shows it.

use taceva_core::{Millimetre, PressOutcome, Specimen};

use super::halt_reason::Trip;
use crate::content_id::ContentId;

/// Something that happened.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Event {
    /// The run begins.
    Started {
        /// Presses of this unit.
        presses: usize,
        /// Of those, finished before.
        finished: usize,
    },
    /// A specimen was mounted.
    Mounted(Specimen),
    /// The light was set.
    Lit(String),
    /// A press is left for another run, because somebody skipped what it needs.
    Skipped(ContentId),
    /// A press begins.
    Approaching {
        /// The press.
        press: ContentId,
        /// Its number among the presses of this unit, from 1.
        number: usize,
    },
    /// The gel was touched.
    Contact {
        /// At this height in the sensor's frame, positive into the gel.
        height: Millimetre,
    },
    /// A frame was not usable and another is awaited.
    FrameRetried,
    /// A sample was taken.
    Sampled {
        /// Its number in the press, from 0.
        number: usize,
    },
    /// The supervisor halted the robot.
    Halted(Trip),
    /// The tip went back from the gel after a halt.
    Retracted,
    /// Nobody holds the enabling switch, and nothing moves until somebody does.
    Unheld,
    /// A press was broken off because signals were silent or the enabling switch was released, and is made again from its start.
    Redone {
        /// The press.
        press: ContentId,
        /// How many times it was broken off.
        times: u32,
    },
    /// A press is finished and durable.
    Finished {
        /// The press.
        press: ContentId,
        /// How it ended.
        outcome: PressOutcome,
    },
    /// A place was visited in the air, in a dry run.
    Rehearsed(ContentId),
}
