//! The clock of a run and the request to stop it: the caller gives both, and nothing here reads a clock of its own.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// The clock of a run: the same that the stamps of the devices are of, in s; it never goes back.
///
/// (Core's [`Clock`](taceva_core::Clock) only says which kind of clock a recording used.)
pub trait Timekeeper {
    /// The time now.
    fn now_s(&self) -> f64;

    /// Lets `rest` pass.
    fn rest(&mut self, rest: Duration);
}

/// A wish to stop that anybody may express from any thread; a run sees it before its next motion.
#[derive(Clone, Debug, Default)]
pub struct Cancel(Arc<AtomicBool>);

impl Cancel {
    /// Not cancelled.
    pub fn new() -> Cancel {
        Cancel::default()
    }

    /// Cancels; this cannot be undone.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Release);
    }

    /// Whether it was cancelled.
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Acquire)
    }
}
