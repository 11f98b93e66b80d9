//! Scores of a task of classes on some rows. A model that has not seen a cluster predicts its classes.

use std::collections::BTreeMap;

use taceva_core::shown;
use taceva_dataset::{Dataset, Task, TaskKind};
use taceva_tasks::events::Frame;
use taceva_tasks::{Classes, TaskScores, TaskState};

use super::clustered_rows::ClusteredRows;
use super::task::{onsets, position, refused};
use crate::classifiers::as_predictor;
use crate::error::EvaluateError;
use crate::fit::FitRequest;
use crate::task_view::{in_words, window_of};
use crate::work::Work;

/// Rows to score.
#[derive(Clone, Copy, Debug)]
pub struct TaskRows<'a> {
    /// Rows of the dataset, ascending. Other rows are not used for training or prediction.
    pub rows: &'a [usize],
    /// Number of rows of a cluster per second, for the times of onsets.
    pub rate_hz: f64,
}

/// Scores the task called `name` in the rows that `of` lists. Models fitted by `fit` predict the classes of clusters that they have not seen.
///
/// # Errors
/// [`EvaluateError`] for an unknown task, a model that does not predict classes, fewer than two clusters, and for the errors of a fit.
pub fn evaluate_task_rows(
    dataset: &Dataset,
    name: &str,
    of: TaskRows<'_>,
    fit: FitRequest,
    work: Work<'_>,
) -> Result<TaskScores, EvaluateError> {
    let of_task = dataset.of_task(name)?;
    let task = of_task.labelled_by();
    let task = task.expect("BUG: the labels are those of the task");
    let fit = as_predictor(fit, task)?;
    let names = dataset.clusters_of(task);
    let strokes = ClusteredRows::of(&names, of.rows);
    let folds = strokes.folds(task, &task.cluster)?;
    let classes = task.names.iter().map(String::as_str);
    let classes = Classes::new(classes, task.positive.as_deref());
    let mut classes = classes.map_err(|error| refused(task, &error))?;
    let mut frames: BTreeMap<&str, Vec<Frame>> = BTreeMap::new();
    strokes.predict_unseen(&of_task, folds, &fit, work, |unseen| {
        let Some([truth, found]) = unseen.pair(&task.name) else {
            return Ok(());
        };
        let [truth, found] = [position(truth, task)?, position(found, task)?];
        let stroke = unseen.of;
        let pushed = classes.push_positions(stroke.name, &[truth], &[found]);
        pushed.map_err(|error| refused(task, &error))?;
        let is_event = |class: u32| is_positive(task, class);
        let time_s = f64::from(stroke.place) / of.rate_hz;
        let score = f64::from(u8::from(is_event(found)));
        let frame = Frame::new(unseen.row as u64 + 1, Some(time_s), is_event(truth), score);
        frames.entry(stroke.name).or_default().push(frame);
        Ok(())
    })?;
    let mut state = TaskState::new(task.name.as_str(), task.kind.name(), task.cluster.as_str());
    state.notes.push(format!(
        "model {}, split cv:{folds} by {}",
        fit.model.name(),
        shown(&task.cluster)
    ));
    let window = window_of(&fit.settings)?;
    state
        .notes
        .extend(window.map(|window| in_words(window, task)));
    state.classes = Some(classes);
    if task.kind == TaskKind::Event {
        state.events = Some(onsets(frames, task)?);
        state.is_sequence = true;
    }
    Ok(state.scores())
}

fn is_positive(task: &Task, class: u32) -> bool {
    let name = task.names.get(class as usize);
    name.is_some() && name == task.positive.as_ref()
}
