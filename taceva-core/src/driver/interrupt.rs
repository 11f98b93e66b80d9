//! Handle to interrupt a call from another thread.

/// Handle that interrupts the pending call of a device, from any thread.
///
/// A waiting call returns [`ErrorKind::Interrupted`](crate::ErrorKind::Interrupted) within 50 ms and leaves the device usable. Without a
/// pending call, the handle does nothing. The handle may outlive the device.
///
/// ```
/// use std::sync::mpsc::{SyncSender, sync_channel};
/// use taceva_core::Interrupt;
///
/// /// Wakes a call that waits for the other end.
/// struct Wake(SyncSender<()>);
///
/// impl Interrupt for Wake {
///     fn interrupt(&self) {
///         // If no call waits, nothing needs waking.
///         let _ = self.0.try_send(());
///     }
/// }
///
/// let (sender, receiver) = sync_channel(1);
/// Wake(sender).interrupt();
/// assert!(receiver.recv().is_ok());
/// ```
pub trait Interrupt: Send + Sync {
    /// Interrupts the pending call. Returns at once, even if that call has not returned.
    fn interrupt(&self);
}
