//! Motion that ends by itself where nobody renews it.

use std::time::Duration;

use super::{Deadline, DriverError, Speed};
use crate::geometry::Pose;
use crate::stamp::Stamp;

/// The ability of a robot to stand where its host falls silent: what it is told holds for a moment and is told again, many times a second.
///
/// It is for ways that lead towards something. A robot without it goes to the end of the motion that it was given, whoever has died
/// meanwhile.
///
/// ```
/// use std::time::Duration;
/// use taceva_core::{Deadline, DriverError, ExpiringMotion, Pose, Speed, Stamp};
///
/// /// Goes for as long as what it was told holds.
/// struct Arm(Pose);
///
/// impl ExpiringMotion for Arm {
///     fn move_expiring(&mut self, target: Pose, _: Speed, _: Deadline) -> Result<Stamp, DriverError> {
///         self.0 = target;
///         Ok(Stamp::at(Duration::ZERO))
///     }
/// }
///
/// let mut arm = Arm(Pose::default());
/// arm.move_expiring(Pose::default(), Speed::try_new(2.0)?, Deadline::PASSED)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait ExpiringMotion {
    /// Moves as [`move_to`](super::Robot::move_to) does, and stands within [`EXPIRES`] after it last heard of its host.
    ///
    /// # Errors
    /// As [`move_to`](super::Robot::move_to).
    fn move_expiring(
        &mut self,
        target: Pose,
        speed: Speed,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError>;
}

/// How long a robot goes on at most that hears nothing more of its host; the way in which it brakes comes to it.
pub const EXPIRES: Duration = Duration::from_millis(200);
