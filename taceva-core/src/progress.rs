//! How a long operation reports its progress, and learns that it should stop.

/// Receives the progress of a long operation, which need not know whether it is shown on a terminal, logged or ignored.
///
/// ```
/// use std::sync::atomic::{AtomicU64, Ordering};
/// use taceva_core::Progress;
///
/// /// Counts steps, and cancels after ten of them.
/// #[derive(Default)]
/// struct Ten(AtomicU64);
///
/// impl Progress for Ten {
///     fn begin(&self, _stage: &str, _steps: Option<u64>) {}
///     fn advance(&self, steps: u64) {
///         self.0.fetch_add(steps, Ordering::Relaxed);
///     }
///     fn end(&self) {}
///     fn is_cancelled(&self) -> bool {
///         self.0.load(Ordering::Relaxed) >= 10
///     }
/// }
///
/// let progress = Ten::default();
/// progress.begin("fit", None);
/// while !progress.is_cancelled() {
///     progress.advance(4);
/// }
/// assert_eq!(progress.0.into_inner(), 12);
/// ```
pub trait Progress: Send + Sync {
    /// A stage begins: what it does, and how many steps it has where that is known.
    fn begin(&self, stage: &str, steps: Option<u64>);
    /// `steps` more of the current stage are done.
    fn advance(&self, steps: u64);
    /// The current stage is over.
    fn end(&self);
    /// Whether the work should stop at the next safe place.
    fn is_cancelled(&self) -> bool;
    /// Whether the stop was asked for a second time: a moving robot is halted where it is, and is not retracted first.
    fn is_insisted(&self) -> bool {
        false
    }
}

/// A progress that shows nothing and never cancels.
///
/// ```
/// use taceva_core::{Progress, SilentProgress};
/// SilentProgress.begin("fit", Some(3));
/// assert!(!SilentProgress.is_cancelled());
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct SilentProgress;

impl Progress for SilentProgress {
    fn begin(&self, _stage: &str, _steps: Option<u64>) {}
    fn advance(&self, _steps: u64) {}
    fn end(&self) {}
    fn is_cancelled(&self) -> bool {
        false
    }
}
