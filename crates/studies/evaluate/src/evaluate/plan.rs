//! Steps of an evaluation, computed before any frame is read.

use taceva_core::{SkipReason, Skipped, counted, shown};
use taceva_dataset::Dataset;

use super::folds;
use super::request::{EvaluateRequest, ModelChoice};
use super::scores::metrics;
use crate::error::EvaluateError;
use crate::fit::FitPlan;
use crate::plan::Plan;
use crate::predict::Target;
use crate::rows::{DataPart, Divided};

/// Computes the steps of [`evaluate`](super::evaluate) without reading frames.
///
/// # Errors
/// [`EvaluateError`] if the request is not valid.
pub fn evaluate_plan(dataset: &Dataset, request: &EvaluateRequest) -> Result<Plan, EvaluateError> {
    request.check_independence(dataset)?;
    let mut plan = Plan::default();
    let rows = counted(dataset.table().rows(), "row");
    plan.step("read", format!("{rows} of {}", shown(&dataset.path())));
    let (target, channels, reads_frames) = match &request.model {
        ModelChoice::Fit(fit) => {
            let fit = match folds::of(dataset, fit, request.part)? {
                Some(folds) => {
                    folds.refuse_part(request)?;
                    folds.explain(&mut plan);
                    folds.first(fit)?
                }
                None => FitPlan::new(dataset, fit)?,
            };
            plan.step("divide", divided_as(&fit.divided));
            fit.explain(&mut plan);
            let (channels, reads_frames) = (fit.channels.clone(), fit.reads_frames());
            (
                Target::of(dataset, Some(fit.divided), request.part, reads_frames)?,
                channels,
                reads_frames,
            )
        }
        ModelChoice::Fitted(model) => {
            plan.skipped
                .push(Skipped::new("stage:fit", SkipReason::AlreadyThere));
            (
                Target::new(dataset, model, request.part)?,
                model.channels().clone(),
                model.reads_frames(),
            )
        }
    };
    let count = target.rows.len();
    if reads_frames {
        plan.step(
            "decode",
            format!(
                "{} of the part `{}`",
                counted(count, "frame"),
                target.part.name()
            ),
        );
    } else {
        plan.skipped
            .push(Skipped::new("field:frame", SkipReason::NothingReadsIt));
    }
    let metrics = metrics(dataset, &channels, request.asked())?;
    let ids: Vec<&str> = metrics.kept().iter().map(|metric| metric.id).collect();
    plan.step("predict", counted(count, "sample"));
    plan.step("score", ids.join(", "));
    plan.skipped.extend(metrics.skipped().iter().cloned());
    Ok(plan)
}

fn divided_as(divided: &Divided) -> String {
    let parts = [DataPart::Train, DataPart::Validation, DataPart::Test];
    let counts: Vec<String> = parts
        .iter()
        .map(|part| format!("{} {}", part.name(), divided.rows(*part).len()))
        .collect();
    format!(
        "{}, seed {}: {}",
        divided.spec,
        divided.seed,
        counts.join(", ")
    )
}
