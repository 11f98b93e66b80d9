//! Predicts and scores the labels of a task of a recording, such as `slip`.

use taceva_dataset::{Dataset, Digest};
use taceva_evaluate::{Work, evaluate_task, subject_of};
use taceva_report::TaskResult as LabelScores;

use super::Common;
use crate::error::SweepError;
use crate::result::TaskResult;
use crate::task::Task;

/// Scores the labels called `name`, and writes the scores, their states and the result of `task`. Scores and states have the bytes of
/// `taceva evaluate --task`.
///
/// # Errors
/// [`SweepError`] if the task fails. No result is written in this case.
pub(super) fn carry_out(
    task: &Task,
    name: &str,
    dataset: &Dataset,
    common: Common<'_>,
    work: Work<'_>,
) -> Result<(), SweepError> {
    let states = evaluate_task(dataset, name, task.request(common.models)?, work)?;
    let report = states.report();
    let folder = common.folder;
    let path = folder.evaluation(&task.key);
    let unwritable = |problem: String| SweepError::Kept {
        path: path.clone(),
        problem,
    };
    let text = serde_json::to_string_pretty(&report);
    let text = text.map_err(|error| unwritable(error.to_string()))? + "\n";
    let scores = LabelScores::of(name, &report).map_err(|error| unwritable(error.to_string()))?;
    let subject = subject_of(dataset);
    let mut result = TaskResult::new(task.key.clone());
    result.source = subject.source;
    result.sensor = subject.sensor;
    result.serial = subject.serial;
    result.add_label_scores(name, &scores.study().scores, &common.list.metrics);
    result.evaluation = Digest::of(text.as_bytes()).to_string();
    let state = folder.label_state(&task.key);
    let mut bytes = Vec::new();
    let written = states.write(&mut bytes);
    written.map_err(SweepError::io("write", &state))?;
    // The result is written last, so that every result has the other files.
    folder.write(&state, &bytes)?;
    folder.write(&path, text.as_bytes())?;
    folder.write(&folder.result(&task.key), result.text()?.as_bytes())
}
