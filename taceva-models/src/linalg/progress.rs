//! Reporting progress, and stopping when asked.

use taceva_core::{ErrorKind, ModelError, Progress};

/// A stage of long work; it ends when it is dropped, also where an error is returned.
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

/// Stops with an error if the work was cancelled.
pub(crate) fn interrupted(progress: &dyn Progress) -> Result<(), ModelError> {
    if progress.is_cancelled() {
        return Err(ModelError::new(
            ErrorKind::Interrupted,
            "fitting was cancelled",
        ));
    }
    Ok(())
}
