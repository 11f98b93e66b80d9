//! Progress reports and cancellation of long operations.

/// Receives the progress of a long operation, to show, log or ignore it.
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
///     fn advance(&self, steps: u64) {
///         self.0.fetch_add(steps, Ordering::Relaxed);
///     }
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
    /// Begins a stage: its name, and its number of steps if that is known. Does nothing by default.
    fn begin(&self, stage: &str, steps: Option<u64>) {
        let _ = (stage, steps);
    }
    /// Reports `steps` more done in the current stage. Does nothing by default.
    fn advance(&self, steps: u64) {
        let _ = steps;
    }
    /// Ends the current stage. Does nothing by default.
    fn end(&self) {}
    /// True if the work should stop at the next safe place.
    fn is_cancelled(&self) -> bool;
    /// True after a second request to stop: a moving robot halts where it is, without retracting first.
    fn is_insisted(&self) -> bool {
        false
    }
    /// Shows `words` at once, also while a question stands, and never waits. Does nothing by default.
    fn remark(&self, words: &str) {
        let _ = words;
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
    fn is_cancelled(&self) -> bool {
        false
    }
}
