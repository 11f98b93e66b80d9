//! Cross-validated fit. The model is fitted on every sample; its scores come from models that were fitted without some samples.

use taceva_dataset::Dataset;
use taceva_models::{Checkpoints, ValidationCard, ValidationScore};
use taceva_results::{EvaluationReport, Interval};

use crate::cache::Cache;
use crate::error::EvaluateError;
use crate::evaluate::{EvaluateRequest, ModelChoice, folds};
use crate::fit::{FitPlan, FitRequest, Fitted, fit};
use crate::work::Work;

/// Metrics in the model's card.
const METRICS: [&str; 2] = ["mae", "r2"];

/// Fits like [`fit`]. If the split of `request` is a cross-validation, the models of the folds give scores on unseen samples. The final model is fitted on
/// every sample, and its card contains these scores. Its settings are chosen by leaving out whole groups of the split. Features are computed once.
///
/// # Errors
/// Errors of [`fit`] and [`evaluate`](crate::evaluate).
pub fn fit_validated(
    dataset: &Dataset,
    request: &FitRequest,
    checkpoints: Option<Checkpoints>,
    work: Work<'_>,
) -> Result<Fitted, EvaluateError> {
    let Some(folds) = folds::asked(dataset, request)? else {
        return fit(dataset, request, checkpoints, work);
    };
    let shared = Cache::of_folds(work.cache);
    let work = Work {
        cache: Some(&shared),
        ..work
    };
    let evaluation = EvaluateRequest {
        model: ModelChoice::Fit(request.clone()),
        metrics: METRICS.map(str::to_owned).to_vec(),
        part: None,
        sensor: None,
        is_independent: false,
    };
    let report = folds.evaluate(&evaluation, request, work)?.report;
    let of_all = FitRequest {
        split: Some("all".to_owned()),
        ..request.clone()
    };
    let mut plan = FitPlan::new(dataset, &of_all)?;
    // As in the folds, settings are chosen by whole groups.
    if let Some(groups) = folds.groups() {
        plan.leave_out_groups(groups);
    }
    if let Some(checkpoints) = checkpoints {
        plan.keep_checkpoints(checkpoints);
    }
    let fitted = plan.run(work)?;
    Ok(Fitted {
        model: fitted.model.with_validation(card(&report)),
        // Reused features of the folds are counted once.
        frames_decoded: fitted.frames_decoded.max(report.provenance.frames_decoded),
        ..fitted
    })
}

fn card(report: &EvaluationReport) -> ValidationCard {
    let provenance = &report.provenance;
    let scores = report.scores.iter().filter_map(|score| {
        let is_stated = METRICS.contains(&score.metric.as_str());
        Some(ValidationScore {
            value: score.value.number().filter(|_| is_stated)?,
            interval: match &score.interval {
                Some(Interval::Ends { ends, .. }) => Some(*ends),
                _ => None,
            },
            metric: score.metric.clone(),
            channel: score.channel.clone(),
        })
    });
    ValidationCard {
        split: provenance.split.clone().unwrap_or_default(),
        seed: provenance.seed.unwrap_or_default(),
        samples: provenance.samples.get("test").copied().unwrap_or_default(),
        neighbours: provenance.neighbours.clone(),
        scores: scores.collect(),
    }
}
