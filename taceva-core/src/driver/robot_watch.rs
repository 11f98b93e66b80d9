//! Handle to read the pose of a robot from another thread.

use super::{Deadline, DriverError};
use crate::geometry::Pose;
use crate::stamp::Stamp;

/// Handle that reads the pose of a robot during a motion, from any thread, over a separate connection.
///
/// The handle may outlive the robot. The calls then return `Disconnected`.
///
/// ```
/// use taceva_core::{Deadline, DriverError, Pose, RobotWatch};
/// /// Present depth of the tip, mm.
/// fn depth_mm(watch: &dyn RobotWatch, deadline: Deadline) -> Result<f64, DriverError> {
///     let (pose, _) = watch.pose(deadline)?;
///     Ok(pose.position.z.0)
/// }
/// ```
pub trait RobotWatch: Send + Sync {
    /// Present pose of the tip of the indenter, and the time of the pose. Never waits for the end of a motion.
    ///
    /// # Units
    /// The units of [`Robot::pose`](super::Robot::pose): mm and degrees in the sensor's frame.
    /// # Errors
    /// [`DriverError`] of kind `Timeout` if no pose arrived within `deadline`, `Disconnected`, or `DeviceFault`, with its
    /// [`Fault`](super::Fault) if the robot names one.
    fn pose(&self, deadline: Deadline) -> Result<(Pose, Stamp), DriverError>;
}
