//! Scores of changes of pose between two frames: a model predicts both poses of pairs that it has not seen.

use std::collections::BTreeMap;

use taceva_core::counted;
use taceva_dataset::{Dataset, RotationVector};
use taceva_tasks::pose::{Pose, PoseError, PoseState, PoseTask, Rotation};
use taceva_tasks::{TaskScores, TaskState};

use super::clustered_rows::ClusteredRows;
use super::pose_task::refused;
use crate::classifiers::as_predictor;
use crate::error::EvaluateError;
use crate::fit::FitRequest;
use crate::task_view::window_of;
use crate::work::Work;

/// Name of the clusters in results. Each pair is a cluster, because no two pairs show the same motion.
const CLUSTER: &str = "pair";

/// Two rows of a dataset, before and after a motion of the object.
#[derive(Clone, Copy, Debug)]
pub struct PosePair {
    /// Row before the motion.
    pub first: usize,
    /// Row after the motion.
    pub second: usize,
}

/// Truth and prediction of x and y in mm, and of the turn about z in degrees.
type Planar = [[f64; 2]; 3];

/// Scores the changes of pose in the task called `name`. Models fitted by `fit` predict both planar poses of pairs that they have not seen.
///
/// A change is a shift along x and y and a turn about z.
///
/// # Errors
/// [`EvaluateError`] for an unknown task, a model that does not predict numbers, fewer than two pairs, and for the errors of a fit.
pub fn evaluate_pose_pairs(
    dataset: &Dataset,
    name: &str,
    pairs: &[PosePair],
    fit: FitRequest,
    work: Work<'_>,
) -> Result<TaskScores, EvaluateError> {
    let of_task = dataset.of_task(name)?;
    let task = of_task.labelled_by();
    let task = task.expect("BUG: the labels are those of the task");
    let channels = ["tx", "ty", "rz"].map(|end| format!("{name}_{end}"));
    let fit = FitRequest {
        channels: channels.to_vec(),
        ..as_predictor(fit, task)?
    };
    if window_of(&fit.settings)?.is_some() {
        return Err(EvaluateError::Request(format!(
            "task `{name}`: the two frames of a pair are predicted one by one, expected a model without `window`"
        )));
    }
    let mut names: Vec<Option<String>> = vec![None; of_task.table().rows()];
    let mut rows = Vec::new();
    for (number, pair) in (1_usize..).zip(pairs) {
        for row in [pair.first, pair.second] {
            names[row] = Some(format!("{CLUSTER} {number}"));
            rows.push(row);
        }
    }
    rows.sort_unstable();
    let clusters = ClusteredRows::of(&names, &rows);
    let folds = clusters.folds(task, CLUSTER)?;
    let mut poses: BTreeMap<usize, Planar> = BTreeMap::new();
    clusters.predict_unseen(&of_task, folds, &fit, work, |unseen| {
        let parts = channels.each_ref().map(|channel| unseen.pair(channel));
        if let [Some(x), Some(y), Some(turn)] = parts {
            poses.insert(unseen.row, [x, y, turn]);
        }
        Ok(())
    })?;
    let mut changes = PoseState::new(PoseTask::default());
    let mut left_out = 0_usize;
    for pair in pairs {
        let both = poses.get(&pair.first).zip(poses.get(&pair.second));
        let (Some((before, after)), Some(cluster)) = (both, names[pair.first].as_deref()) else {
            left_out += 1;
            continue;
        };
        let side = |side: usize| change(pair.second as u64 + 1, [before, after], side);
        let change = side(0).and_then(|truth| Ok([truth, side(1)?]));
        let [truth, predicted] = change.map_err(|error| refused(task, &error))?;
        changes.push(cluster, &truth, &predicted);
    }
    let mut state = TaskState::new(name, task.kind.name(), CLUSTER);
    state.notes.push(format!(
        "model {}, split cv:{folds} by {CLUSTER}",
        fit.model.name()
    ));
    if left_out > 0 {
        let words = counted(left_out, CLUSTER);
        state
            .notes
            .push(format!("{words} without two pictures, left out"));
    }
    state.pose = Some(changes);
    Ok(state.scores())
}

/// Motion from the pose `before` to the pose `after`: the true motion if `side` is 0, the predicted one if it is 1. Errors state `row`.
fn change(row: u64, [before, after]: [&Planar; 2], side: usize) -> Result<Pose, PoseError> {
    let part = |part: usize| after[part][side] - before[part][side];
    let turned = RotationVector::new([0.0, 0.0, part(2)]);
    let rotation = Rotation::of_quaternion(row, turned.quaternion())?;
    Pose::new(row, [part(0), part(1), 0.0], rotation)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_of_pose_is_a_shift_and_a_turn_of_one_side() {
        let before: Planar = [[0.25, 0.0], [0.5, 0.5], [10.0, 0.0]];
        let after: Planar = [[0.5, 0.0], [0.25, 0.5], [40.0, 0.0]];
        let truth = change(1, [&before, &after], 0).expect("numbers");
        let [x, y, z] = truth.translation_mm();
        assert!((x - 0.25).abs() < 1e-12 && (y + 0.25).abs() < 1e-12 && z.abs() < 1e-12);
        assert!((truth.rotation().yaw_degrees() - 30.0).abs() < 1e-9);
        let predicted = change(1, [&before, &after], 1).expect("numbers");
        assert!(predicted.distance_mm(&Pose::ZERO) < 1e-12);
    }
}
