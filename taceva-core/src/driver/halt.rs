//! Handle to halt a robot from another thread.

use super::DriverError;

/// Handle that stops a robot from any thread, in every state, during any other call.
///
/// The handle may outlive the robot: once the robot is dropped, the halt succeeds without effect. The halt is not a safety function: only the
/// emergency stop of the site is.
///
/// ```
/// use std::sync::atomic::{AtomicBool, Ordering};
/// use taceva_core::{DriverError, Halt};
///
/// /// Flag that the robot checks before each step of a motion.
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
/// let latch = Latch::default();
/// latch.halt()?;
/// latch.halt()?;
/// assert!(latch.0.into_inner());
/// # Ok::<(), DriverError>(())
/// ```
pub trait Halt: Send + Sync {
    /// Stops the motion within 50 ms. Later moves fail until [`clear_halt`](super::Robot::clear_halt). Never waits for the end of another call.
    ///
    /// # Errors
    /// [`DriverError`] of kind `Disconnected` if the robot did not receive the stop. The halt is still latched on the host.
    fn halt(&self) -> Result<(), DriverError>;
}
