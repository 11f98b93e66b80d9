//! Scores of a task of poses: a regressor predicts translations and rotation vectors of clusters that it has not seen.

use std::collections::BTreeMap;

use taceva_core::shown;
use taceva_dataset::{Dataset, RotationVector, Task};
use taceva_results::Samples;
use taceva_tasks::pose::{Pose, PoseError, PoseState, Rotation};
use taceva_tasks::{TaskState, WorstSample};

use super::label_counts::{own_labels, unscored};
use super::task::without_cluster;
use crate::error::EvaluateError;
use crate::pose_definition::pose_definition;

/// Sums behind the scores of the poses in `samples`, which contains predictions of the channels of `task`. `clusters` has the cluster of every row of
/// the dataset.
pub(super) fn state(
    dataset: &Dataset,
    task: &Task,
    clusters: &[Option<String>],
    samples: &Samples,
) -> Result<TaskState, EvaluateError> {
    let names = dataset.table().samples().iter();
    let rows: BTreeMap<&str, usize> = names.map(String::as_str).zip(0..).collect();
    let channels = task.channels();
    let channels: Vec<_> = channels
        .iter()
        .map(|name| samples.channel(name).expect("a channel of the task"))
        .collect();
    let mut state = TaskState::new(task.name.as_str(), task.kind.name(), task.cluster.as_str());
    let mut poses = PoseState::new(pose_definition(&task.name, task.thresholds.as_ref())?);
    let mut scored: u64 = 0;
    for row in 0..samples.rows() {
        let pairs: Option<Vec<[f64; 2]>> =
            channels.iter().map(|channel| channel.pair(row)).collect();
        let Some(pairs) = pairs else {
            continue;
        };
        let sample = samples
            .word("sample", row)
            .and_then(|sample| rows.get(sample).copied());
        let of_row = sample.zip(sample.and_then(|row| clusters[row].as_deref()));
        let (at, cluster) = of_row.ok_or_else(|| without_cluster(task))?;
        let side = |side: usize| pose(row as u64 + 1, &pairs, side);
        let both = side(0).and_then(|truth| Ok([truth, side(1)?]));
        let [truth, predicted] = both.map_err(|error| refused(task, &error))?;
        poses.push(cluster, &truth, &predicted);
        let sample = dataset.table().samples()[at].as_str();
        let error = truth.distance_mm(&predicted);
        let worst = WorstSample::new(at, sample, cluster, error, "mm");
        state.evidence.add_worst(worst);
        scored += 1;
    }
    state.pose = Some(poses);
    state
        .notes
        .extend(unscored(scored, own_labels(dataset, &task.name)));
    Ok(state)
}

/// Pose of a row from the six pairs of numbers in `pairs`: the true pose if `side` is 0, the predicted one if it is 1.
fn pose(row: u64, pairs: &[[f64; 2]], side: usize) -> Result<Pose, PoseError> {
    let part = |at: usize| pairs[at][side];
    let turned = RotationVector::new([part(3), part(4), part(5)]);
    let rotation = Rotation::of_quaternion(row, turned.quaternion())?;
    Pose::new(row, [part(0), part(1), part(2)], rotation)
}

pub(super) fn refused(task: &Task, error: &PoseError) -> EvaluateError {
    EvaluateError::Request(format!("task `{}`: {error}", shown(&task.name)))
}
