//! Scores of contact shapes on the presses of the ball. The depth map of the predicted place and depth is compared with the true depth map.

use taceva_acquire::{PlannedScene, PlannedStudy};
use taceva_dataset::Dataset;
use taceva_evaluate::{BallPresses, Predicted, contact_shapes};
use taceva_protocol::PhaseKind;

use super::phase_rows::PhaseRows;
use super::task::TaskOutcome;
use crate::error::StudyError;

/// Name of the task in the report.
const SHAPE: &str = "shape";

/// Scores of contact shapes, or the reason why there are none. `None` if the scene asks for none, or without plan, predictions or footprint.
pub(super) fn of(
    scene: &PlannedScene,
    study: &PlannedStudy,
    dataset: &Dataset,
    phase_rows: &PhaseRows<'_>,
    predicted: Option<&(Predicted, Vec<usize>)>,
) -> Result<Option<TaskOutcome>, StudyError> {
    let protocol = &scene.scene.protocol;
    // Without a plan, every row of a recording belongs to every phase.
    if protocol.shape.presses.value == 0 || phase_rows.protocol().is_none() {
        return Ok(None);
    }
    if let Some(reason) = phase_rows.skipped(PhaseKind::Shape) {
        return Ok(Some(TaskOutcome::skipped(SHAPE, reason)));
    }
    let (Some((predicted, of_rows)), Some(footprint)) = (predicted, study.plan.footprint) else {
        return Ok(None);
    };
    let rows = phase_rows.rows(PhaseKind::Shape);
    let of = BallPresses {
        rows: &rows,
        radius_mm: protocol.contact.indenter_radius_mm.value,
        pixel_mm: protocol.shape.pixel_mm.value,
        footprint,
    };
    let scores = contact_shapes(dataset, SHAPE, predicted, of_rows, of);
    TaskOutcome::of(SHAPE, scores).map(Some)
}
