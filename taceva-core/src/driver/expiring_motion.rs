//! Robot motion that stops unless the host repeats the command.

use std::time::Duration;

use super::{Deadline, DriverError, Speed};
use crate::geometry::Pose;
use crate::stamp::Stamp;

/// Ability of a robot to stop if its host stops sending. Each command is valid for a short time and is repeated many times a second.
///
/// Use this for motions towards a surface. Robots without this ability complete a motion even if the commanding program has ended.
///
/// ```
/// use std::time::Duration;
/// use taceva_core::{Deadline, DriverError, ExpiringMotion, Pose, Speed, Stamp};
///
/// /// Moves for as long as its last command is valid.
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
    /// Moves as [`move_to`](super::Robot::move_to) does, and begins to brake at most 200 ms ([`EXPIRES`]) after the last message of the host.
    ///
    /// # Errors
    /// The errors of [`move_to`](super::Robot::move_to).
    fn move_expiring(
        &mut self,
        target: Pose,
        speed: Speed,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError>;
}

/// Maximum time from the last message of the host until the robot begins to brake.
pub const EXPIRES: Duration = Duration::from_millis(200);
