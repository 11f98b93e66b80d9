//! Progress reports and cancellation of long operations.

/// Receives the progress of a long operation, to show, log or ignore the reports.
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
    /// Begins a stage with its name and its number of steps; `None` if unknown. Does nothing by default.
    fn begin(&self, stage: &str, steps: Option<u64>) {
        let _ = (stage, steps);
    }
    /// Reports `steps` further completed steps of the current stage. Does nothing by default.
    fn advance(&self, steps: u64) {
        let _ = steps;
    }
    /// Ends the current stage. Does nothing by default.
    fn end(&self) {}
    /// True if the operation should stop at the next safe point.
    fn is_cancelled(&self) -> bool;
    /// True after a second request to stop. A moving robot then halts at once, without retracting first.
    fn is_insisted(&self) -> bool {
        false
    }
    /// Shows `words` at once, even while a question is open, and never waits. Does nothing by default.
    fn remark(&self, words: &str) {
        let _ = words;
    }
}

/// Progress receiver that shows nothing and never cancels.
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
