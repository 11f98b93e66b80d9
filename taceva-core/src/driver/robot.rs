//! A robot that moves the indenter.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::{Deadline, DriverError, ExpiringMotion, GuardedMotion, Halt, RobotWatch, Speed};
use crate::geometry::Pose;
use crate::stamp::Stamp;

/// A robot that moves the indenter.
///
/// # Units
/// Poses in mm and degrees in the sensor's frame; z points into the gel.
///
/// # The physical contract
/// - Opening moves nothing: the robot keeps its position.
/// - [`move_to`](Robot::move_to) moves the tip along a straight line and blocks until the tip rests. No other call moves the tip.
/// - [`halt`](Robot::halt) stops the motion. The robot then refuses every later move with `Interrupted` until
///   [`clear_halt`](Robot::clear_halt). A halt between two moves is therefore never lost.
/// - After an error the robot is at rest. `pose`, `halt` and `clear_halt` are then safe to call.
///
/// ```
/// use std::sync::Arc;
/// use std::sync::atomic::{AtomicBool, Ordering};
/// use std::time::Duration;
/// use taceva_core::{Deadline, DriverError, DriverKey, ErrorKind, Halt, Pose, Robot, Speed, Stamp};
///
/// const ARM: DriverKey = DriverKey::fixed("org.example/arm");
///
/// /// Arrives at once.
/// #[derive(Default)]
/// struct Arm {
///     pose: Pose,
///     halted: Arc<Latch>,
/// }
///
/// #[derive(Default)]
/// struct Latch(AtomicBool);
///
/// impl Halt for Latch {
///     fn halt(&self) -> Result<(), DriverError> {
///         self.0.store(true, Ordering::Release);
///         Ok(())
///     }
/// }
///
/// impl Robot for Arm {
///     fn pose(&mut self, _: Deadline) -> Result<(Pose, Stamp), DriverError> {
///         Ok((self.pose, Stamp::at(Duration::ZERO)))
///     }
///     fn move_to(&mut self, target: Pose, _: Speed, _: Deadline) -> Result<Stamp, DriverError> {
///         if self.halted.0.load(Ordering::Acquire) {
///             return Err(DriverError::new(ErrorKind::Interrupted, &ARM, "move"));
///         }
///         self.pose = target;
///         Ok(Stamp::at(Duration::ZERO))
///     }
///     fn halt_handle(&self) -> Arc<dyn Halt> {
///         Arc::clone(&self.halted) as Arc<dyn Halt>
///     }
///     fn clear_halt(&mut self, _: Deadline) -> Result<(), DriverError> {
///         self.halted.0.store(false, Ordering::Release);
///         Ok(())
///     }
/// }
///
/// let mut arm = Arm::default();
/// let speed = Speed::try_new(10.0)?;
/// arm.halt()?;
/// let error = arm.move_to(Pose::default(), speed, Deadline::PASSED).unwrap_err();
/// assert_eq!(error.kind(), ErrorKind::Interrupted);
/// arm.clear_halt(Deadline::PASSED)?;
/// arm.move_to(Pose::default(), speed, Deadline::PASSED)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Robot: Send {
    /// Pose of the tip of the indenter, and the time of the pose.
    ///
    /// # Errors
    /// [`DriverError`] of kind `Timeout`, `Disconnected`, or `DeviceFault` for a coordinate that is not finite.
    fn pose(&mut self, deadline: Deadline) -> Result<(Pose, Stamp), DriverError>;

    /// Moves the tip to `target` along a straight line, blocks until the tip rests there, and returns the time of arrival.
    ///
    /// If `deadline` passes first, the robot stops before the call returns the error.
    ///
    /// # Errors
    /// [`DriverError`] of kind
    /// - `InvalidArgument` for a coordinate that is not finite,
    /// - `OutOfRange` for a target outside the workspace or a speed above the maximum; the robot does not move,
    /// - `Timeout` if the tip did not arrive within `deadline`,
    /// - `Interrupted` if the robot was halted, before or during the motion,
    /// - `DeviceFault` if the robot reports a fault. The error includes the [`Fault`](super::Fault) if its kind is known.
    fn move_to(
        &mut self,
        target: Pose,
        speed: Speed,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError>;

    /// Handle that stops this robot from any thread, during any other call.
    fn halt_handle(&self) -> Arc<dyn Halt>;

    /// Handle that reads the pose of this robot from any thread during a motion; `None` if the robot allows no second connection.
    fn watch_handle(&self) -> Option<Arc<dyn RobotWatch>> {
        None
    }

    /// True if the device reports that software emulates the robot. Recordings with an emulated robot are not measurements.
    fn is_emulated(&self) -> bool {
        false
    }

    /// Settings read from the robot, by name, such as `firmware` with `2.7.0`. A recording stores them. Empty if no setting is known.
    fn settings(&self) -> BTreeMap<String, String> {
        BTreeMap::new()
    }

    /// Warnings for the operator about a working robot: a speed below the requested speed, unknown limits. Each states a remedy.
    fn warnings(&self) -> Vec<String> {
        Vec::new()
    }

    /// Stops the robot. Allowed in every state and idempotent.
    ///
    /// # Errors
    /// The errors of [`Halt::halt`].
    fn halt(&mut self) -> Result<(), DriverError> {
        self.halt_handle().halt()
    }

    /// Clears a halt, so that the robot accepts moves again. Does nothing without a halt. Moves nothing.
    ///
    /// Clears only a halt by [`halt`](Robot::halt), never a [`Fault`](super::Fault) of the device: a person must inspect and acknowledge a
    /// fault at the device.
    ///
    /// # Errors
    /// [`DriverError`] of kind `DeviceFault` if the device still reports a fault that a person must acknowledge.
    fn clear_halt(&mut self, deadline: Deadline) -> Result<(), DriverError>;

    /// Interface to motions that the robot ends at a force limit; `None` if the robot lacks them.
    fn guarded_motion(&mut self) -> Option<&mut dyn GuardedMotion> {
        None
    }

    /// Interface to motions that the robot ends if its host stops sending; `None` if the robot lacks them.
    fn expiring_motion(&mut self) -> Option<&mut dyn ExpiringMotion> {
        None
    }
}
