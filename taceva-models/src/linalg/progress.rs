//! Progress reports and cancellation.

use taceva_core::{ErrorKind, ModelError, Progress};

/// Stage of a long computation, reported to a progress receiver. Dropping it ends the stage, also on errors.
pub(crate) struct ReportedStage<'a> {
    progress: &'a dyn Progress,
}

impl<'a> ReportedStage<'a> {
    pub(crate) fn begin(progress: &'a dyn Progress, name: &str, steps: usize) -> ReportedStage<'a> {
        progress.begin(name, u64::try_from(steps).ok());
        ReportedStage { progress }
    }

    pub(crate) fn advance(&self) {
        self.advance_by(1);
    }

    pub(crate) fn advance_by(&self, steps: u64) {
        self.progress.advance(steps);
    }
}

impl Drop for ReportedStage<'_> {
    fn drop(&mut self) {
        self.progress.end();
    }
}

/// Returns an error if the computation was cancelled.
pub(crate) fn interrupted(progress: &dyn Progress) -> Result<(), ModelError> {
    if progress.is_cancelled() {
        return Err(ModelError::new(
            ErrorKind::Interrupted,
            "fitting was cancelled",
        ));
    }
    Ok(())
}
