//! Observations for the supervisor, and the stages of a press.

use taceva_core::{Pose, Stamp, Wrench};

/// An observation that the supervisor checks.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Observation {
    /// A reading of the force transducer.
    Force(Wrench, Stamp),
    /// A reading of the force transducer, with its sequence number.
    Numbered(Wrench, Stamp, u64),
    /// Pose during the motion announced by [`Supervisor::sent`](super::Supervisor::sent), read by a guard thread.
    UnderWay {
        /// Pose of the tip.
        pose: Pose,
        /// Time of the pose.
        stamp: Stamp,
    },
    /// Pose at rest, after a motion to `target`.
    Pose {
        /// Pose of the tip.
        pose: Pose,
        /// Time of the pose.
        stamp: Stamp,
        /// Target of the motion.
        target: Pose,
    },
    /// A timeout of the transducer without a reading.
    Silence,
}

/// Stage of a press. It determines which forces are allowed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum MotionStage {
    /// In the air. A force above `threshold_n` is a collision.
    Travel {
        /// Greatest force without a collision, in N.
        threshold_n: f64,
    },
    /// At rest in the air while the transducer sets its zero. Forces are ignored.
    Zeroing,
    /// Approach to the first contact.
    Search,
    /// In contact. Depths are measured from `height_mm`.
    Press {
        /// Height relative to which depths are measured, in mm of the sensor frame. It is the height of the first contact, or of a surface fitted
        /// slightly above it.
        height_mm: f64,
    },
    /// Retreat from the gel. The normal force must not exceed `force_n` or the limit of the normal force, whichever is greater.
    Retreat {
        /// Normal force at the start of the retreat, in N.
        force_n: f64,
    },
}
