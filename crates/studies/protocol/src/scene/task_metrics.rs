//! Scores of tasks that a scene may request, with the phase whose presses they score.

use super::counts::Protocol;
use crate::phase_kind::PhaseKind;

/// Names of the scores of slip detection.
const OF_SLIP: [&str; 12] = [
    "class_accuracy",
    "balanced_accuracy",
    "f1",
    "f1_macro",
    "precision",
    "recall",
    "specificity",
    "kappa",
    "mcc",
    "onset_f1",
    "onset_delay",
    "false_alarms",
];
/// Names of the scores of contact shapes.
const OF_SHAPE: [&str; 6] = [
    "depth_mae",
    "depth_rmse",
    "depth_bias",
    "depth_max",
    "contact_iou",
    "normal_angle",
];
/// Names of the scores of predicted changes of pose.
const OF_POSE: [&str; 3] = ["pose_translation", "pose_axis", "pose_rotation"];

/// Phases of tasks, with the names of their scores.
const PHASES: [(PhaseKind, &[&str]); 3] = [
    (PhaseKind::Slip, &OF_SLIP),
    (PhaseKind::Shape, &OF_SHAPE),
    (PhaseKind::Pose, &OF_POSE),
];

/// Phase whose presses `metric` scores; `None` for a metric that is not a score of a task.
pub(crate) fn phase_of_task(metric: &str) -> Option<PhaseKind> {
    let mut phases = PHASES.into_iter();
    let of = phases.find(|(_, metrics)| metrics.contains(&metric));
    of.map(|(phase, _)| phase)
}

/// Names of all scores of tasks.
pub(super) fn task_metrics() -> impl Iterator<Item = &'static str> {
    let phases = PHASES.into_iter();
    phases.flat_map(|(_, metrics)| metrics.iter().copied())
}

/// Line of a scene that requests presses of `phase`. `None` if `protocol` already requests some, or if the phase measures no task.
pub(super) fn missing_line(phase: PhaseKind, protocol: &Protocol) -> Option<&'static str> {
    let (count, line) = match phase {
        PhaseKind::Slip => (&protocol.slip.strokes, "slip = { strokes = 40 }"),
        PhaseKind::Shape => (&protocol.shape.presses, "shape = { presses = 40 }"),
        PhaseKind::Pose => (&protocol.pose.pairs, "pose = { pairs = 40 }"),
        _ => return None,
    };
    (count.value == 0).then_some(line)
}
