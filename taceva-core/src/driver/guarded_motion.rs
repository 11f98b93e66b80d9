//! Motion that the robot itself ends at a force.

use super::{Deadline, DriverError, Speed};
use crate::geometry::Pose;
use crate::quantity::Newton;
use crate::stamp::Stamp;

/// The ability of a robot to watch the force by itself, faster than a host could.
pub trait GuardedMotion {
    /// Moves as [`move_to`](super::Robot::move_to) does, and stops by itself once `guard` is reached.
    ///
    /// # Errors
    /// As [`move_to`](super::Robot::move_to); also `InvalidArgument` for a guard that is not above 0 N.
    fn move_guarded(
        &mut self,
        target: Pose,
        speed: Speed,
        guard: Guard,
        deadline: Deadline,
    ) -> Result<GuardedStop, DriverError>;
}

/// What ends a guarded motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Guard {
    /// The magnitude of the force at which the robot stops.
    pub force: Newton,
}

/// How a guarded motion ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum GuardedStop {
    /// At the target, without reaching the guard.
    Arrived {
        /// When it came to rest.
        stamp: Stamp,
    },
    /// At the guard.
    Guarded {
        /// Where it came to rest, beyond the place where the guard was reached.
        pose: Pose,
        /// When it came to rest.
        stamp: Stamp,
    },
}
