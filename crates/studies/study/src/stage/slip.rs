//! Scores of slip detection on the strokes of a study.

use taceva_acquire::PlannedScene;
use taceva_dataset::{Dataset, Task, TaskKind, TaskLabel};
use taceva_evaluate::{EvaluateError, FitRequest, TaskRows, evaluate_task_rows};
use taceva_models::ModelSettings;
use taceva_protocol::PhaseKind;

use super::context::RunContext;
use super::phase_rows::PhaseRows;
use super::task::TaskOutcome;
use crate::error::StudyError;

/// Name of the task in the report.
const SLIP: &str = "slip";
/// Least share of the limit of friction at which a frame is labelled slip. The outermost part of a contact slides earlier.
const SHARE: f64 = 0.9;
/// Name of the model that predicts slip from few strokes: linear discriminant analysis of small pictures.
const MODEL: &str = "lda";
/// Setting of the model: the size of the small pictures, in cells along each side.
const GRID: &str = "size=8x8";

/// Scores of slip, or the reason why there are none. `None` if the study has no stroke, or the recording no plan.
pub(super) fn of(
    scene: &PlannedScene,
    dataset: &Dataset,
    phase_rows: &PhaseRows<'_>,
    context: RunContext<'_>,
) -> Result<Option<TaskOutcome>, StudyError> {
    let rows = phase_rows.rows(PhaseKind::Slip);
    let spec = &scene.scene.protocol.slip;
    // Without a plan, every row of a recording belongs to every phase.
    let is_planned = phase_rows.protocol().is_some();
    if spec.strokes.value == 0 || rows.is_empty() || !is_planned {
        return Ok(None);
    }
    let Some(labels) = labels(dataset, &rows, spec.friction.value) else {
        let reason = "slip is labelled by Fx, Fy and Fz, and the rig does not measure all of them";
        return Ok(Some(TaskOutcome::skipped(SLIP, reason)));
    };
    let mut task = Task::new(SLIP, TaskKind::Event, "point_id");
    task.names = vec!["no_slip".to_owned(), SLIP.to_owned()];
    task.positive = Some(SLIP.to_owned());
    task.rule = Some(format!(
        "shear force of {SHARE} or more of the limit of friction, {} times the normal force",
        spec.friction.value
    ));
    let labelled = dataset.with_task(task, &labels);
    let labelled = labelled.map_err(EvaluateError::from)?;
    let window = format!("window={}", spec.window.value);
    let request = || -> Result<FitRequest, EvaluateError> {
        Ok(FitRequest {
            model: context.models.find(MODEL)?,
            settings: ModelSettings::parse([GRID, window.as_str()])?,
            channels: Vec::new(),
            split: None,
            seed: scene.scene.seed,
        })
    };
    let of = TaskRows {
        rows: &rows,
        rate_hz: spec.rate_hz.value,
    };
    let scores = evaluate_task_rows(&labelled, SLIP, of, request()?, context.work);
    TaskOutcome::of(SLIP, scores).map(Some)
}

/// Class of each row of the dataset: 1 for slip, otherwise 0; `None` outside `rows` or without contact. No labels without Fx, Fy and Fz.
fn labels(dataset: &Dataset, rows: &[usize], friction: f64) -> Option<Vec<Option<TaskLabel>>> {
    let table = dataset.table();
    let [x, y, z] = ["Fx", "Fy", "Fz"].map(|name| table.channels().position(name));
    let [x, y, z] = [x?, y?, z?].map(|position| table.truth(position));
    let mut labels = vec![None; table.rows()];
    for &row in rows {
        let forces = x.get(row).zip(y.get(row)).zip(z.get(row));
        if let Some(((x, y), z)) = forces.filter(|(_, z)| z.abs() > 0.0) {
            let slips = x.hypot(y) >= SHARE * friction * z.abs();
            labels[row] = Some(TaskLabel::Class(u32::from(slips)));
        }
    }
    Some(labels)
}
