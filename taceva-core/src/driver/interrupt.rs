//! Ending a call from another thread.

/// Ends the pending call of the device it came from: from any thread, beside any other call.
///
/// A call that waits returns [`ErrorKind::Interrupted`](crate::ErrorKind::Interrupted) within 50 ms and leaves the device usable; where
/// none is pending nothing happens. It outlives the device harmlessly.
pub trait Interrupt: Send + Sync {
    /// Ends the pending call, and never waits for it.
    fn interrupt(&self);
}
