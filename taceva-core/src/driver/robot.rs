//! A robot that moves the indenter.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::{Deadline, DriverError, ExpiringMotion, GuardedMotion, Halt, RobotWatch, Speed};
use crate::geometry::Pose;
use crate::stamp::Stamp;

/// A robot that carries the indenter.
///
/// # Units
/// Poses in mm and degrees in the sensor's frame; z points into the gel.
///
/// # The physical contract
/// - Opening moves nothing; the robot holds its position.
/// - [`move_to`](Robot::move_to) moves the tip along a straight line and blocks until it rests there. No other call moves it.
/// - [`halt`](Robot::halt) stops the motion and latches: every later move is refused with `Interrupted` until
///   [`clear_halt`](Robot::clear_halt). A halt between two moves is therefore never lost.
/// - After an error the robot stands still. `pose`, `halt` and `clear_halt` are safe to call then.
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
    /// Pose of the tip, and its time.
    ///
    /// # Errors
    /// [`DriverError`] of kind `Timeout`, `Disconnected`, or `DeviceFault` for a coordinate that is not finite.
    fn pose(&mut self, deadline: Deadline) -> Result<(Pose, Stamp), DriverError>;

    /// Moves the tip to `target` along a straight line, blocks until it rests there, and returns the time of arrival.
    ///
    /// If `deadline` passes first, the motion is stopped before the error is returned.
    ///
    /// # Errors
    /// [`DriverError`] of kind
    /// - `InvalidArgument` for a coordinate that is not finite,
    /// - `OutOfRange` for a target outside the workspace or a speed above the greatest; nothing moves,
    /// - `Timeout` if it did not arrive within `deadline`,
    /// - `Interrupted` if it was halted, before or during the motion,
    /// - `DeviceFault` if it reports a fault, with its [`Fault`](super::Fault) if it is one of those.
    fn move_to(
        &mut self,
        target: Pose,
        speed: Speed,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError>;

    /// A handle that stops this robot from any thread, while any other call is under way.
    fn halt_handle(&self) -> Arc<dyn Halt>;

    /// Handle that watches this robot from any thread while it moves; `None` without a second connection for it.
    fn watch_handle(&self) -> Option<Arc<dyn RobotWatch>> {
        None
    }

    /// True if the device reports that it is emulated, so that nothing recorded with it was measured.
    fn is_emulated(&self) -> bool {
        false
    }

    /// Settings of the robot as read from it, by name, such as `firmware` with `2.7.0`; a recording keeps them. Empty if none is known.
    fn settings(&self) -> BTreeMap<String, String> {
        BTreeMap::new()
    }

    /// Remarks for the operator on a robot that works: a slower speed than asked for, limits that are unknown. Each states its remedy.
    fn warnings(&self) -> Vec<String> {
        Vec::new()
    }

    /// Stops the robot. Legal in every state and idempotent.
    ///
    /// # Errors
    /// As [`Halt::halt`].
    fn halt(&mut self) -> Result<(), DriverError> {
        self.halt_handle().halt()
    }

    /// Ends a halt, so that moves are accepted again; without one it does nothing. Nothing moves.
    ///
    /// Ends only the halt of [`halt`](Robot::halt). A [`Fault`](super::Fault) of the device is never cleared: a person looks, and
    /// acknowledges it at the device.
    ///
    /// # Errors
    /// [`DriverError`] of kind `DeviceFault` if the device itself still reports a fault that a person must acknowledge.
    fn clear_halt(&mut self, deadline: Deadline) -> Result<(), DriverError>;

    /// Motion that the robot itself ends at a force; `None` if unsupported.
    fn guarded_motion(&mut self) -> Option<&mut dyn GuardedMotion> {
        None
    }

    /// Motion that the robot itself ends when its host stops sending; `None` if unsupported.
    fn expiring_motion(&mut self) -> Option<&mut dyn ExpiringMotion> {
        None
    }
}
