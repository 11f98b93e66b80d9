//! Enabling switch that a person holds while a robot may move.

use super::DriverError;

/// Enabling switch. The robot may move while a person holds the switch, and halts on release.
///
/// The switch is not a safety function: its state passes through an operating system and a program. The switch of the robot's own safety
/// circuit remains necessary.
///
/// A caller polls the switch at least as often as a release must be noticed, and treats an error as a release.
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
    /// True if the switch has been held without a break since the last call. Reports a release once, even a short one. Never blocks. Before
    /// the first received state, the switch counts as released.
    ///
    /// # Errors
    /// [`DriverError`] of kind `Disconnected` once the switch is gone, or of another kind if its state is unknown.
    fn is_held(&self) -> Result<bool, DriverError>;
}
