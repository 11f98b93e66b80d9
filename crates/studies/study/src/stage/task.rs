//! Scores of a task for the report of a study, or the reason why there are none.

use serde::Serialize;
use taceva_evaluate::EvaluateError;
use taceva_results::{EvaluationReport, Skip, StudyTask};

use crate::error::StudyError;

/// Scores of a task, or the reason why there are none.
pub(super) enum TaskOutcome {
    Scored(StudyTask),
    Skipped(Skip),
}

impl TaskOutcome {
    /// Outcome of the task called `name`. A request that the samples cannot fulfil is a skip.
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
            Err(EvaluateError::Request(reason)) => Ok(TaskOutcome::skipped(name, reason)),
            Err(error) => Err(error.into()),
        }
    }

    pub(super) fn skipped(name: &str, reason: impl Into<String>) -> TaskOutcome {
        TaskOutcome::Skipped(Skip {
            what: format!("task:{name}"),
            reason: reason.into(),
        })
    }

    /// Adds the outcome to `report`.
    pub(super) fn add_to(self, report: &mut EvaluationReport) {
        match self {
            TaskOutcome::Scored(scores) => report.tasks.push(scores),
            TaskOutcome::Skipped(skip) => report.skipped.push(skip),
        }
    }
}
