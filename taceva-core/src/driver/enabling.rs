//! Enabling switch that a person holds while a robot may move.

use super::DriverError;

/// Enabling switch. The robot may move while a person holds the switch, and halts on release.
///
/// The switch is not a safety function: its state passes through an operating system and a program. The switch of the robot's own safety
/// circuit remains necessary.
///
/// A caller must poll the switch often enough to halt the robot in time, and treat an error as a release.
///
/// ```
/// use std::sync::atomic::{AtomicBool, Ordering};
/// use taceva_core::{DriverError, EnablingSwitch};
///
/// /// A switch on the screen.
/// #[derive(Default)]
/// struct Button {
///     is_held: AtomicBool,
/// }
///
/// impl EnablingSwitch for Button {
///     fn is_held(&self) -> Result<bool, DriverError> {
///         Ok(self.is_held.load(Ordering::Acquire))
///     }
/// }
///
/// /// True if the robot may move.
/// fn may_move(switch: &dyn EnablingSwitch) -> bool {
///     switch.is_held().unwrap_or(false)
/// }
/// assert!(!may_move(&Button::default()));
/// ```
pub trait EnablingSwitch: Send + Sync {
    /// True if the switch has been held without a break since the last call. After a short release, one call returns `false`. Never
    /// blocks. Before the driver receives a state, the switch counts as released.
    ///
    /// # Errors
    /// [`DriverError`] of kind `Disconnected` once the connection to the switch is lost, or of another kind if its state is unknown.
    fn is_held(&self) -> Result<bool, DriverError>;
}
