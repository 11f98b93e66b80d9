//! Scores of a task for the report of a study, or the reason why there are none.

use serde::Serialize;
use taceva_core::ErrorKind;
use taceva_evaluate::EvaluateError;
use taceva_results::{EvaluationReport, Skip, StudyTask};

use crate::error::StudyError;

/// Scores of a task, or the reason why there are none.
pub(super) enum TaskOutcome {
    Scored(StudyTask),
    Skipped(Skip),
}

impl TaskOutcome {
    /// Outcome of the task with the name `name`. If the samples do not allow a request or a fit, the task is skipped.
    pub(super) fn of<T: Serialize>(
        name: &str,
        scores: Result<T, EvaluateError>,
    ) -> Result<TaskOutcome, StudyError> {
        match scores {
            Ok(scores) => {
                let task = serde_json::to_value(&scores);
                let task = task.map_err(|error| EvaluateError::Request(error.to_string()))?;
                Ok(TaskOutcome::Scored(StudyTask::new(task)))
            }
            // The recording is complete. A task without a possible fit must not cost the other scores.
            Err(error @ (EvaluateError::Request(_) | EvaluateError::Model(_)))
                if error.kind() != ErrorKind::Interrupted =>
            {
                Ok(TaskOutcome::skipped(name, error.to_string()))
            }
            Err(error) => Err(error.into()),
        }
    }

    pub(super) fn skipped(name: &str, reason: impl Into<String>) -> TaskOutcome {
        TaskOutcome::Skipped(Skip {
            what: format!("task:{name}"),
            reason: reason.into(),
        })
    }

    /// Adds the scores of the task, or the reason for skipping it, to `report`.
    pub(super) fn add_to(self, report: &mut EvaluationReport) {
        match self {
            TaskOutcome::Scored(scores) => report.tasks.push(scores),
            TaskOutcome::Skipped(skip) => report.skipped.push(skip),
        }
    }
}

#[cfg(test)]
mod tests {
    use taceva_core::ModelError;

    use super::*;

    #[test]
    fn a_fit_that_the_samples_do_not_allow_is_a_skip_and_an_interruption_is_none() {
        let outcome = |kind: ErrorKind| {
            let failed = ModelError::new(kind, "2 samples, expected at least 3");
            TaskOutcome::of::<()>("pose", Err(failed.into()))
        };
        let Ok(TaskOutcome::Skipped(skip)) = outcome(ErrorKind::InvalidArgument) else {
            panic!("expected a skip");
        };
        assert_eq!(skip.what, "task:pose");
        assert_eq!(skip.reason, "2 samples, expected at least 3");
        assert!(outcome(ErrorKind::Interrupted).is_err());
    }
}
