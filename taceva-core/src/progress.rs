//! Progress reports and cancellation of operations that take long.

/// Receiver of the progress of an operation that takes long. The receiver may also cancel the operation.
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
    /// Begins the stage called `stage` with a number of steps; `None` if unknown. Does nothing by default.
    fn begin(&self, stage: &str, steps: Option<u64>) {
        let _ = (stage, steps);
    }
    /// Reports `steps` further completed steps of the current stage. Does nothing by default.
    fn advance(&self, steps: u64) {
        let _ = steps;
    }
    /// Ends the current stage. Does nothing by default.
    fn end(&self) {}
    /// True if the operation should stop as soon as it safely can.
    fn is_cancelled(&self) -> bool;
    /// True after a second request to stop. An operation that moves a robot then halts the robot at once, without retracting first.
    fn is_insisted(&self) -> bool {
        false
    }
    /// Shows `words` without delay, even while the user is asked a question. The call does not block. Does nothing by default.
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
