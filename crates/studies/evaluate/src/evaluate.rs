//! Evaluates a model on a dataset, step by step: divide, fit, predict, score.

mod callers_model;
mod clustered_rows;
mod contact_shape;
mod depth_cells;
mod depth_task;
mod divisions;
mod fit_task;
mod fold_progress;
pub(crate) mod folds;
mod label_counts;
mod notes;
mod passes;
mod plan;
mod pose_pairs;
mod pose_task;
mod request;
mod scores;
mod task;
mod task_errors;
mod task_rows;

use taceva_dataset::Dataset;
use taceva_metrics::catalogue;

use crate::assess::FitFacts;
use crate::error::EvaluateError;
use crate::fit::FitPlan;
use crate::note::Note;
use crate::predict::{self, Target};
use crate::work::Work;

pub use callers_model::{GivenModel, GivenRequest, GivenRows};
pub use contact_shape::{BallPresses, contact_shapes};
pub use divisions::{FoldedRows, fold_divisions, scored_by_default, scored_of_task};
pub use fit_task::fit_task;
pub use plan::evaluate_plan;
pub use pose_pairs::{PosePair, evaluate_pose_pairs};
pub use request::{Asked, EvaluateRequest, Evaluated, ModelChoice};
pub use scores::{Behind, score};
pub use task::{evaluate_task, task_division};
pub use task_rows::{TaskRows, evaluate_task_rows};

/// Evaluates `dataset`: fits the model if requested, predicts the samples that the model has not seen, and scores them.
///
/// # Errors
/// [`EvaluateError`] if the request is not valid, the model does not fit the dataset, or the dataset cannot be read.
pub fn evaluate(
    dataset: &Dataset,
    request: &EvaluateRequest,
    work: Work<'_>,
) -> Result<Evaluated, EvaluateError> {
    request.check_independence(dataset)?;
    match &request.model {
        ModelChoice::Fit(fit) => {
            // Checked first, so that an unknown metric does not cost a fit.
            catalogue::select(request.metrics.iter().map(String::as_str))?;
            if let Some(folds) = folds::of(dataset, fit, request.part)? {
                return folds.evaluate(request, fit, work);
            }
            let plan = FitPlan::new(dataset, fit)?;
            if request.part.is_none() {
                plan.divided.require_test()?;
            }
            let fitted = plan.run(work)?;
            let model = &fitted.model;
            let target = Target::of(
                dataset,
                Some(fitted.divided),
                request.part,
                model.reads_frames(),
            )?;
            let predicted = predict::predict_target(dataset, model, &target, work)?;
            let notes = Note::left_out("training and validation", fitted.left_out);
            let behind = Behind {
                fit: FitFacts {
                    frames_decoded: fitted.frames_decoded,
                    notes: notes.into_iter().collect(),
                },
                ..Behind::of(model)?
            };
            let scored = score(
                dataset,
                request.asked(),
                behind,
                &target,
                &predicted,
                work.jobs,
            )?;
            Ok(Evaluated {
                manifest: Some(fitted.manifest),
                ..scored
            })
        }
        ModelChoice::Fitted(model) => {
            let target = Target::new(dataset, model, request.part)?;
            let predicted = predict::predict_target(dataset, model, &target, work)?;
            let behind = Behind::of(model)?;
            let scored = score(
                dataset,
                request.asked(),
                behind,
                &target,
                &predicted,
                work.jobs,
            )?;
            let manifest = target
                .divided
                .map(|divided| divided.manifest(dataset.table()))
                .transpose()?;
            Ok(Evaluated { manifest, ..scored })
        }
    }
}
