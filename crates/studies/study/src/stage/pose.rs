//! Scores of changes of pose on pairs of presses of a board: the shift of the board along the gel, and the turn about its axis.

use std::collections::BTreeMap;

use taceva_acquire::{PlannedScene, PlannedStudy};
use taceva_dataset::{Dataset, RotationVector, Task, TaskKind, TaskLabel};
use taceva_evaluate::{EvaluateError, FitRequest, PosePair, evaluate_pose_pairs};
use taceva_protocol::{PhaseKind, Press};

use super::context::RunContext;
use super::phase_rows::PhaseRows;
use super::task::TaskOutcome;
use crate::error::StudyError;
use crate::models::fit_request;

/// Name of the task in the report.
const POSE: &str = "pose";

/// Scores of changes of pose, or the reason why there are none. `None` if the scene asks for none or fits no model, or if there is no plan.
pub(super) fn of(
    scene: &PlannedScene,
    study: &PlannedStudy,
    dataset: &Dataset,
    phase_rows: &PhaseRows<'_>,
    context: RunContext<'_>,
) -> Result<Option<TaskOutcome>, StudyError> {
    // Without a plan, every row of a recording belongs to every phase.
    if scene.scene.protocol.pose.pairs.value == 0 || phase_rows.protocol().is_none() {
        return Ok(None);
    }
    if let Some(reason) = phase_rows.skipped(PhaseKind::Pose) {
        return Ok(Some(TaskOutcome::skipped(POSE, reason)));
    }
    let Some(request) = fit_request(study, scene.scene.seed, context.models) else {
        return Ok(None);
    };
    let request = with_first_seed(scene, request?)?;
    let rows = phase_rows.rows(PhaseKind::Pose);
    let Boards { labels, pairs } = Boards::of(study, dataset, &rows);
    let mut task = Task::new(POSE, TaskKind::Pose, "point_id");
    task.frame = Some("board in the frame of the sensor".to_owned());
    task.rule = Some("measured place, planned turn about z".to_owned());
    let labelled = dataset.with_task(task, &labels);
    let labelled = labelled.map_err(EvaluateError::from)?;
    let scores = evaluate_pose_pairs(&labelled, POSE, &pairs, request, context.work);
    TaskOutcome::of(POSE, scores).map(Some)
}

/// Request `request` with the first seed that the user gives for trainings, if there is one.
fn with_first_seed(scene: &PlannedScene, request: FitRequest) -> Result<FitRequest, EvaluateError> {
    match scene.seeds.first() {
        Some(seed) => request.with_seed(*seed),
        None => Ok(request),
    }
}

/// Poses of the boards in the presses of a recording.
struct Boards {
    /// Pose for each row of the dataset; `None` for rows of other presses, or without a measured place.
    labels: Vec<Option<TaskLabel>>,
    /// Pairs of rows, of which both presses were recorded.
    pairs: Vec<PosePair>,
}

impl Boards {
    /// Collects the poses of the boards in `rows`, whose samples are named `<press>/<number>`.
    fn of(study: &PlannedStudy, dataset: &Dataset, rows: &[usize]) -> Boards {
        let planned = study.plan.presses_of(PhaseKind::Pose);
        let presses: BTreeMap<String, &Press> = planned
            .map(|planned| (planned.id.to_string(), &planned.press))
            .collect();
        let table = dataset.table();
        let [x, y] = ["Px", "Py"].map(|name| table.channels().position(name));
        let mut labels = vec![None; table.rows()];
        let mut by_number: BTreeMap<u32, usize> = BTreeMap::new();
        for &row in rows {
            let press = table.samples()[row].split_once('/');
            let press = press.and_then(|(press, _)| presses.get(press));
            let measured =
                |position: Option<usize>| position.and_then(|at| table.truth(at).get(row));
            let (Some(press), Some(x), Some(y)) = (press, measured(x), measured(y)) else {
                continue;
            };
            let turn = f64::from(press.turn_millidegrees) / 1e3;
            let [qx, qy, qz, qw] = RotationVector::new([0.0, 0.0, turn]).quaternion();
            labels[row] = Some(TaskLabel::Pose([x, y, 0.0, qx, qy, qz, qw]));
            if let Some(number) = press.repeat {
                by_number.insert(number, row);
            }
        }
        // The presses 2 n and 2 n + 1 are a pair.
        let firsts = by_number.iter().filter(|(number, _)| *number % 2 == 0);
        let pairs = firsts.filter_map(|(number, first)| {
            let second = by_number.get(&(number + 1))?;
            Some(PosePair {
                first: *first,
                second: *second,
            })
        });
        Boards {
            pairs: pairs.collect(),
            labels,
        }
    }
}
