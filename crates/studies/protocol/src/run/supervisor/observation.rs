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
        /// Pose.
        pose: Pose,
        /// Time of the pose.
        stamp: Stamp,
    },
    /// Pose at rest, after a motion to `target`.
    Pose {
        /// Pose.
        pose: Pose,
        /// Time of the pose.
        stamp: Stamp,
        /// Target.
        target: Pose,
    },
    /// A timeout without a reading.
    Silence,
}

/// Stage of a press, which sets the allowed forces.
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
    /// In contact, below `height_mm`.
    Press {
        /// Height relative to which depths are measured, in mm of the sensor frame. It is the height of the first contact, or of the fitted surface
        /// above it.
        height_mm: f64,
    },
    /// Retreat. The force must not exceed `force_n`.
    Retreat {
        /// Force at the start of the retreat, in N.
        force_n: f64,
    },
}
