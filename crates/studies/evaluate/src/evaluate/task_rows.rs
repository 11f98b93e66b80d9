//! Scores of a task of classes on some rows of a dataset: each cluster is predicted by a model that has not seen it.

use std::collections::BTreeMap;

use taceva_core::shown;
use taceva_dataset::{Dataset, Task, TaskKind};
use taceva_models::Split;
use taceva_tasks::events::Frame;
use taceva_tasks::{Classes, TaskScores, TaskState};

use super::task::{MOST_FOLDS, onsets, position, refused};
use crate::classifiers::as_predictor;
use crate::error::EvaluateError;
use crate::fit::{FitPlan, FitRequest, Recipe};
use crate::predict::{Predicted, Target, predict_target};
use crate::rows::Divided;
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

/// Fits `fit` to the classes of the task called `name` in the rows `of`, predicts clusters that it has not seen, and scores them.
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
    let strokes = Strokes::of(&names, of.rows);
    let folds = strokes.count.min(MOST_FOLDS);
    if folds < 2 {
        return Err(EvaluateError::Request(format!(
            "task `{}`: {} different values of `{}`, expected two or more",
            shown(name),
            strokes.count,
            shown(&task.cluster)
        )));
    }
    let classes = task.names.iter().map(String::as_str);
    let classes = Classes::new(classes, task.positive.as_deref());
    let mut classes = classes.map_err(|error| refused(task, &error))?;
    let mut frames: BTreeMap<&str, Vec<Frame>> = BTreeMap::new();
    for fold in 0..folds {
        let divided = strokes.divided(&of_task, fold, folds, fit.seed)?;
        let fitted = FitPlan::on(&of_task, &fit, Recipe::of(&fit)?, divided)?.run(work)?;
        let model = &fitted.model;
        let target = Target::of(&of_task, Some(fitted.divided), None, model.reads_frames())?;
        let predicted = predict_target(&of_task, model, &target, work)?;
        for (at, row) in target.rows.iter().enumerate() {
            let Some((stroke, [truth, found])) = strokes.by_row.get(row).zip(pair(&predicted, at))
            else {
                continue;
            };
            let [truth, found] = [position(truth, task)?, position(found, task)?];
            let pushed = classes.push_positions(stroke.name, &[truth], &[found]);
            pushed.map_err(|error| refused(task, &error))?;
            let is_event = |class: u32| is_positive(task, class);
            let time_s = f64::from(stroke.place) / of.rate_hz;
            let score = f64::from(u8::from(is_event(found)));
            let frame = Frame::new(*row as u64 + 1, Some(time_s), is_event(truth), score);
            frames.entry(stroke.name).or_default().push(frame);
        }
    }
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

/// Truth and prediction of the sample at `at`.
fn pair(predicted: &Predicted, at: usize) -> Option<[f64; 2]> {
    let truth = predicted.truth().first()?.get(at)?;
    Some([truth, predicted.prediction().first()?.get(at)?])
}

fn is_positive(task: &Task, class: u32) -> bool {
    let name = task.names.get(class as usize);
    name.is_some() && name == task.positive.as_ref()
}

/// Place of a row in its cluster.
struct Stroke<'a> {
    name: &'a str,
    /// Number of the cluster.
    number: usize,
    /// Number of rows of the cluster before this one.
    place: u32,
}

/// Clusters of rows, in the order of their first rows.
struct Strokes<'a> {
    by_row: BTreeMap<usize, Stroke<'a>>,
    count: usize,
}

impl<'a> Strokes<'a> {
    /// Clusters of `rows` by the names of all rows. Rows without a cluster are left out.
    fn of(names: &'a [Option<String>], rows: &[usize]) -> Strokes<'a> {
        let mut lengths: BTreeMap<&str, (usize, u32)> = BTreeMap::new();
        let mut by_row = BTreeMap::new();
        for &row in rows {
            let Some(name) = names[row].as_deref() else {
                continue;
            };
            let next = lengths.len();
            let (number, length) = lengths.entry(name).or_insert((next, 0));
            let stroke = Stroke {
                name,
                number: *number,
                place: *length,
            };
            *length += 1;
            by_row.insert(row, stroke);
        }
        Strokes {
            by_row,
            count: lengths.len(),
        }
    }

    /// Division that tests every cluster with a number equal to `fold` modulo `folds`, and trains on all others.
    fn divided(
        &self,
        dataset: &Dataset,
        fold: usize,
        folds: usize,
        seed: u64,
    ) -> Result<Divided, EvaluateError> {
        let is_tested = |row: &usize| self.by_row[row].number % folds == fold;
        let (test, train) = self.by_row.keys().copied().partition(is_tested);
        let left_out = dataset.all_rows().into_iter();
        Ok(Divided {
            spec: format!("cv:{folds} by-point").parse()?,
            seed,
            split: Split {
                train,
                test,
                left_out: left_out
                    .filter(|row| !self.by_row.contains_key(row))
                    .collect(),
                ..Split::default()
            },
            neighbours: None,
            groups: None,
            are_independent: false,
            folds: Vec::new(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_of_a_cluster_have_its_number_and_their_places_and_a_row_without_one_is_left_out() {
        let names = ["a", "b", "a", "b", "a"].map(|name| Some(name.to_owned()));
        let names: Vec<Option<String>> = names.into_iter().chain([None]).collect();
        let strokes = Strokes::of(&names, &[1, 2, 3, 4, 5]);
        assert_eq!(strokes.count, 2);
        let found: Vec<(usize, u32)> = strokes
            .by_row
            .values()
            .map(|stroke| (stroke.number, stroke.place))
            .collect();
        assert_eq!(found, [(0, 0), (1, 0), (0, 1), (1, 1)]);
    }
}
