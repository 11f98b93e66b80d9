//! Scores of a task: a model predicts the labels of clusters that it has not seen.

use std::collections::{BTreeMap, BTreeSet};

use taceva_core::{Field, shown};
use taceva_dataset::{Dataset, Task, TaskKind};
use taceva_results::Samples;
use taceva_tasks::events::{EventRule, EventState, Frame};
use taceva_tasks::{Classes, TaskError, TaskState};

use super::label_counts::{own_labels, unscored};
use super::task_errors::{self, TaskMistake};
use super::{EvaluateRequest, Evaluated, ModelChoice, depth_task, evaluate, pose_task};
use crate::classifiers::as_predictor;
use crate::error::EvaluateError;
use crate::fit::FitRequest;
use crate::score_states::ScoreStates;
use crate::subject;
use crate::task_state_file::TaskStates;
use crate::task_view::{in_words, window_of};
use crate::work::Work;

/// Maximum number of folds of the default division.
pub(super) const MOST_FOLDS: usize = 5;

/// Division that keeps each cluster of `task` whole: five folds, or one fold for each cluster if there are fewer than five.
///
/// # Errors
/// [`EvaluateError::Request`] for fewer than two clusters.
pub fn task_division(dataset: &Dataset, task: &Task) -> Result<String, EvaluateError> {
    let clusters = dataset.clusters_of(task);
    let distinct: BTreeSet<&str> = clusters.iter().flatten().map(String::as_str).collect();
    let folds = distinct.len().min(MOST_FOLDS);
    if folds < 2 {
        return Err(EvaluateError::Request(format!(
            "task `{}`: {} different values of `{}`, expected two or more: samples with equal values resemble each other, so they are never \
             in both the training and the test part",
            shown(&task.name),
            distinct.len(),
            shown(&task.cluster)
        )));
    }
    Ok(match task.cluster == Field::Point.name() {
        true => format!("cv:{folds} by-point"),
        false => format!("cv:{folds} by-column:{}", task.cluster),
    })
}

/// Fits a model by `fit` to the labels of the task called `name`, predicts the samples of unseen clusters, and scores them.
///
/// Without a stated split, [`task_division`] divides the samples. The model of classes is one of
/// [`CLASSIFIERS`](crate::CLASSIFIERS); poses and depth maps need a model of numbers.
///
/// # Errors
/// [`EvaluateError`] for an unknown task, a model that cannot predict a task of this kind, or a split that separates samples of one cluster.
/// Otherwise errors of [`evaluate`].
pub fn evaluate_task(
    dataset: &Dataset,
    name: &str,
    fit: FitRequest,
    work: Work<'_>,
) -> Result<TaskStates, EvaluateError> {
    let mut tasks = dataset.tasks().iter().map(|own| own.task());
    let task = tasks.find(|task| task.name == name);
    let has_maps = task.is_some_and(|task| task.kind == TaskKind::Depth);
    let of_task = match has_maps {
        true => None,
        false => Some(dataset.of_task(name)?),
    };
    let task = task.expect("`of_task` found the task");
    let fit = as_predictor(fit, task)?;
    let split = split_of(dataset, task, fit.split.as_deref())?;
    let mut notes = vec![format!("model {}, split {split}", fit.model.name())];
    let window = window_of(&fit.settings)?;
    notes.extend(window.map(|window| in_words(window, task)));
    let mut state = match &of_task {
        None => depth_task::state(dataset, task, fit, &split, work)?,
        Some(of_task) => {
            let evaluated = evaluate(of_task, &request_of(fit, split), work)?;
            of_labels(dataset, task, evaluated)?
        }
    };
    notes.append(&mut state.notes);
    state.notes = notes;
    let labelled = own_labels(dataset, name);
    state.unlabelled = (dataset.table().rows() - labelled) as u64;
    let digest = [("dataset".to_owned(), dataset.digest().to_string())];
    let mut states = TaskStates::new("by their row of the dataset".to_owned(), digest.into());
    states.sources.insert(subject::of(dataset).source);
    states.tasks.push(state);
    Ok(states)
}

/// Sums behind the scores of a task of classes or of poses, from its predicted samples.
fn of_labels(
    dataset: &Dataset,
    task: &Task,
    evaluated: Evaluated,
) -> Result<TaskState, EvaluateError> {
    let (report, shares) = (evaluated.report, evaluated.shares);
    let samples = report.samples.expect("an evaluation keeps its samples");
    let clusters = dataset.clusters_of(task);
    match task.kind {
        TaskKind::Pose => pose_task::state(dataset, task, &clusters, &samples),
        _ => Predicted::of(dataset, task, &clusters, &samples, shares.as_deref())?
            .state(dataset, task),
    }
}

/// The split `stated`, or the default division of `task` if no split is stated.
fn split_of(dataset: &Dataset, task: &Task, stated: Option<&str>) -> Result<String, EvaluateError> {
    match stated {
        Some(split) => {
            check_split(split, task)?;
            Ok(split.to_owned())
        }
        None => task_division(dataset, task),
    }
}

/// Request for an evaluation that predicts the labels of the test part. Its metrics are not used.
fn request_of(fit: FitRequest, split: String) -> EvaluateRequest {
    EvaluateRequest {
        model: ModelChoice::Fit(FitRequest {
            channels: Vec::new(),
            split: Some(split),
            ..fit
        }),
        metrics: vec!["mae".to_owned()],
        part: None,
        sensor: None,
        is_independent: false,
    }
}

/// Predicted samples of a task, with the cluster of every row of the dataset.
struct Predicted<'a> {
    clusters: &'a [Option<String>],
    classes: Classes,
    /// Scores of the probabilities of classes; `None` if the model estimates none.
    scored: Option<ScoreStates>,
    /// Frames of each cluster, with the positive class as the event.
    frames: BTreeMap<&'a str, Vec<Frame>>,
    /// Samples whose predicted class is wrong.
    wrong: Vec<TaskMistake<'a>>,
}

impl<'a> Predicted<'a> {
    fn of(
        dataset: &Dataset,
        task: &Task,
        clusters: &'a [Option<String>],
        samples: &Samples,
        shares: Option<&[f64]>,
    ) -> Result<Predicted<'a>, EvaluateError> {
        let names = dataset.table().samples().iter();
        let rows: BTreeMap<&str, usize> = names.map(String::as_str).zip(0..).collect();
        let positive = task.positive.as_deref();
        let classes = Classes::new(task.names.iter().map(String::as_str), positive);
        let scored = shares.map(|_| ScoreStates::new(&task.names, positive, true));
        let scored = scored.transpose().map_err(|error| refused(task, &error))?;
        let mut found = Predicted {
            clusters,
            classes: classes.map_err(|error| refused(task, &error))?,
            scored,
            frames: BTreeMap::new(),
            wrong: Vec::new(),
        };
        let positive = task.names.iter().position(|name| positive == Some(name));
        let is_event = |class: u32| positive == Some(class as usize);
        let channel = samples
            .channel(&task.name)
            .expect("the channel of the task");
        let times = dataset.table().t_s();
        for at in 0..samples.rows() {
            let Some([truth, predicted]) = channel.pair(at) else {
                continue;
            };
            let sample = samples
                .word("sample", at)
                .and_then(|sample| rows.get(sample).copied());
            let of_row = sample.zip(sample.and_then(|row| clusters[row].as_deref()));
            let (row, cluster) = of_row.ok_or_else(|| without_cluster(task))?;
            let [truth, predicted] = [position(truth, task)?, position(predicted, task)?];
            found
                .classes
                .push_positions(cluster, &[truth], &[predicted])
                .map_err(|error| refused(task, &error))?;
            if let (Some(scored), Some(shares)) = (&mut found.scored, shares) {
                let width = task.names.len();
                scored
                    .push(cluster, truth, &shares[at * width..][..width])
                    .map_err(|error| refused(task, &error))?;
            }
            if truth != predicted {
                found.wrong.push(TaskMistake {
                    row,
                    cluster,
                    truth,
                    predicted,
                });
            }
            let score = f64::from(u8::from(is_event(predicted)));
            let frame = Frame::new(row as u64 + 1, times[row], is_event(truth), score);
            found.frames.entry(cluster).or_default().push(frame);
        }
        Ok(found)
    }

    /// Sums behind the scores of `task`, with remarks for its report.
    fn state(self, dataset: &Dataset, task: &Task) -> Result<TaskState, EvaluateError> {
        let mut state = TaskState::new(task.name.as_str(), task.kind.name(), task.cluster.as_str());
        let single = of_one_cluster(dataset, task, self.clusters);
        state.notes.extend(single);
        let unscored = unscored(self.classes.n(), own_labels(dataset, &task.name));
        state.notes.extend(unscored);
        state.classes = Some(self.classes);
        if let Some(scored) = self.scored {
            scored
                .add_to(&mut state)
                .map_err(|error| refused(task, &error))?;
        }
        if task.kind == TaskKind::Event {
            state.events = Some(onsets(self.frames, task)?);
            state.is_sequence = true;
        }
        task_errors::add(&mut state, self.wrong, dataset, task);
        Ok(state)
    }
}

/// Remark on each class that occurs in a single cluster. The model that predicts this cluster has not learnt the class.
fn of_one_cluster(dataset: &Dataset, task: &Task, clusters: &[Option<String>]) -> Vec<String> {
    let mut found: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    let own = dataset.table().task(&task.name);
    for (row, cluster) in clusters.iter().enumerate() {
        if let (Some(class), Some(cluster)) = (own.and_then(|own| own.class(row)), cluster) {
            found.entry(class).or_default().insert(cluster);
        }
    }
    let single = found
        .into_iter()
        .filter(|(_, clusters)| clusters.len() == 1);
    let words = single.map(|(class, _)| {
        format!(
            "the class `{}` is in one cluster only, so the model that predicts this cluster has not learnt it: record it in another cluster",
            shown(class)
        )
    });
    words.collect()
}

/// Sums behind the scores of the onsets of an event. Frames are sorted by time within each cluster.
pub(super) fn onsets(
    clusters: BTreeMap<&str, Vec<Frame>>,
    task: &Task,
) -> Result<EventState, EvaluateError> {
    let mut state = EventState::new(EventRule::default());
    for (cluster, mut frames) in clusters {
        let time = |frame: &Frame| frame.time_s.unwrap_or_default();
        frames.sort_by(|one, other| time(one).total_cmp(&time(other)));
        state.push(cluster, &frames).map_err(|error| {
            EvaluateError::Request(format!("task `{}`: {error}", shown(&task.name)))
        })?;
    }
    Ok(state)
}

/// Refuses a split that may put samples of one cluster into both the training and the test part.
pub(super) fn check_split(split: &str, task: &Task) -> Result<(), EvaluateError> {
    let by = match task.cluster == Field::Point.name() {
        true => "by-point".to_owned(),
        false => format!("by-column:{}", task.cluster),
    };
    let keeps = [by.as_str(), "by-recording", "leave-one-recording-out"];
    let named = split
        .split(' ')
        .map(|word| word.split('=').next().unwrap_or(word));
    if named.clone().any(|word| keeps.contains(&word)) {
        return Ok(());
    }
    Err(EvaluateError::Request(format!(
        "task `{}`: the split `{}` can put samples of one `{}` into both the training and the test part, where they resemble each other; \
         expected `{by}`, `cv:5 {by}`, or no --split",
        shown(&task.name),
        shown(split),
        shown(&task.cluster)
    )))
}

/// Index of the class of `task` whose channel value is `number`.
pub(super) fn position(number: f64, task: &Task) -> Result<u32, EvaluateError> {
    let classes = (0_u32..).take(task.names.len());
    let found = classes
        .into_iter()
        .find(|class| (f64::from(*class) - number).abs() < 1e-6);
    found.ok_or_else(|| {
        EvaluateError::Request(format!(
            "task `{}`: the model predicts {number}, expected the position of a class, a whole number below {}",
            shown(&task.name),
            task.names.len()
        ))
    })
}

pub(super) fn without_cluster(task: &Task) -> EvaluateError {
    EvaluateError::Request(format!(
        "task `{}`: a sample has no value in the cluster column `{}`: fill the column in, or state another `cluster` in the map",
        shown(&task.name),
        shown(&task.cluster)
    ))
}

pub(super) fn refused(task: &Task, error: &TaskError) -> EvaluateError {
    EvaluateError::Request(format!("task `{}`: {error}", shown(&task.name)))
}
