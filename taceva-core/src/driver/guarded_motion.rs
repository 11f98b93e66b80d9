//! Robot motion that ends at a force limit.

use super::{Deadline, DriverError, Speed};
use crate::geometry::Pose;
use crate::quantity::Newton;
use crate::stamp::Stamp;

/// Ability of a robot to monitor the force by itself, faster than a host could.
///
/// ```
/// use std::time::Duration;
/// use taceva_core::{
///     Deadline, DriverError, Guard, GuardedMotion, GuardedStop, Millimetre, Newton, Pose, Speed, Stamp,
/// };
///
/// /// A gel of 2 N/mm that begins at z = 0.
/// struct OverGel;
///
/// impl GuardedMotion for OverGel {
///     fn move_guarded(
///         &mut self,
///         mut target: Pose,
///         _: Speed,
///         guard: Guard,
///         _: Deadline,
///     ) -> Result<GuardedStop, DriverError> {
///         let stamp = Stamp::at(Duration::ZERO);
///         let deepest = Millimetre(guard.force.0 / 2.0);
///         if target.position.z <= deepest {
///             return Ok(GuardedStop::Arrived { stamp });
///         }
///         target.position.z = deepest;
///         Ok(GuardedStop::Guarded { pose: target, stamp })
///     }
/// }
///
/// let mut target = Pose::default();
/// target.position.z = Millimetre(1.0);
/// let guard = Guard::at(Newton(0.5));
/// let stop = OverGel.move_guarded(target, Speed::try_new(1.0)?, guard, Deadline::PASSED)?;
/// assert!(matches!(stop, GuardedStop::Guarded { pose, .. } if pose.position.z == Millimetre(0.25)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait GuardedMotion {
    /// Moves as [`move_to`](super::Robot::move_to) does, and stops once the force reaches the limit in `guard`.
    ///
    /// # Errors
    /// The errors of [`move_to`](super::Robot::move_to); also `InvalidArgument` for a guard that is not above 0 N.
    fn move_guarded(
        &mut self,
        target: Pose,
        speed: Speed,
        guard: Guard,
        deadline: Deadline,
    ) -> Result<GuardedStop, DriverError>;
}

/// Force limit that ends a guarded motion.
///
/// ```
/// use taceva_core::{Guard, Newton};
/// assert_eq!(Guard::at(Newton(0.5)).force.to_string(), "0.5 N");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Guard {
    /// Magnitude of the force at which the robot stops.
    pub force: Newton,
}

impl Guard {
    /// A guard that ends a motion when the force reaches `force`.
    pub const fn at(force: Newton) -> Guard {
        Guard { force }
    }
}

/// End of a guarded motion. This enum gets no further variant: any other end is an error.
///
/// ```
/// use std::time::Duration;
/// use taceva_core::{GuardedStop, Stamp};
/// let stop = GuardedStop::Arrived { stamp: Stamp::at(Duration::from_secs(1)) };
/// assert!(matches!(stop, GuardedStop::Arrived { stamp } if stamp.valid_s == 1.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum GuardedStop {
    /// The robot rests at the target; the force did not reach the limit.
    Arrived {
        /// Time at which the robot came to rest.
        stamp: Stamp,
    },
    /// The force reached the limit, and the robot stopped.
    Guarded {
        /// Pose of the tip at rest, after the braking distance.
        pose: Pose,
        /// Time at which the robot came to rest.
        stamp: Stamp,
    },
}
