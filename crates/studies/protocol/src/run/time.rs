//! Clock and cancellation of a run, which the caller provides. This crate reads no clock itself.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Clock of a run, in s. It stamps the readings of the devices, and never runs backwards.
///
/// [`Clock`](taceva_core::Clock) of the core crate is not a clock: it names the kind of clock of a recording.
pub trait Timekeeper {
    /// Current time, in s.
    fn now_s(&self) -> f64;

    /// Waits for the duration `rest`.
    fn rest(&mut self, rest: Duration);
}

/// Cancellation that any thread can request. A run stops before its next motion.
#[derive(Clone, Debug, Default)]
pub struct Cancel(Arc<AtomicBool>);

impl Cancel {
    /// Creates a cancellation that has not been requested.
    pub fn new() -> Cancel {
        Cancel::default()
    }

    /// Requests the cancellation. The request cannot be withdrawn.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Release);
    }

    /// True if [`cancel`](Cancel::cancel) was called.
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Acquire)
    }
}
