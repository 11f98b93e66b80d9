//! What a supervisor is shown, and in which part of a press.

use taceva_core::{Pose, Stamp, Wrench};

/// A reading that the supervisor checks.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Observation {
    /// A reading of the force transducer.
    Force(Wrench, Stamp),
    /// A reading of the force transducer, with the number that it gave it.
    Numbered(Wrench, Stamp, u64),
    /// The pose that the robot reported during the motion announced by [`Supervisor::sent`](super::Supervisor::sent), as a thread that watches it
    /// saw it.
    UnderWay {
        /// Where it is.
        pose: Pose,
        /// When that was true.
        stamp: Stamp,
    },
    /// The pose that the robot reported at rest, after it was sent to `target`.
    Pose {
        /// Where it is.
        pose: Pose,
        /// When that was true.
        stamp: Stamp,
        /// Where it should be.
        target: Pose,
    },
    /// No reading; time passed.
    Silence,
}

/// In which part of a press the tip is: what is allowed depends on it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum MotionStage {
    /// In the air: force above `threshold_n` is a collision.
    Travel {
        /// The force that counts as contact.
        threshold_n: f64,
    },
    /// At rest in the air while the transducer sets its zero: forces mean nothing.
    Zeroing,
    /// On the way to the first contact.
    Search,
    /// In contact since the tip was at `height_mm`.
    Press {
        /// The height of the first contact in the sensor's frame.
        height_mm: f64,
    },
    /// On the way back, where the force must not rise above `force_n`.
    Retreat {
        /// The force at which the retreat began.
        force_n: f64,
    },
}
