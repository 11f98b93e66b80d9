//! What a supervisor is shown, and in which part of a press.

use taceva_core::{Pose, Stamp, Wrench};

/// A reading that the supervisor checks.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Observation {
    /// The force transducer said this.
    Force(Wrench, Stamp),
    /// The force transducer said this, and gave the reading this number.
    Numbered(Wrench, Stamp, u64),
    /// The robot said this under way from and to where [`Supervisor::sent`](super::Supervisor::sent) was told; seen by a thread of its own.
    UnderWay {
        /// Where it is.
        pose: Pose,
        /// When that was true.
        stamp: Stamp,
    },
    /// The robot said this, after it was sent to `target` and came to rest.
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
