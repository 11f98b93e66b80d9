//! Pass 3: removes phases and models that no planned metric needs.

use taceva_core::{Field, SkipReason};

use super::collect::{Collected, Fit};
use super::study_facts::{ModelChoice, StudyFacts};
use crate::phase_kind::PhaseKind;
use crate::reason::{Cause, PlanReason, Subject};

/// Removes tasks without a model, then models that nothing reads, then phases that no metric, model or task uses.
pub(super) fn pass(mut collected: Collected, facts: &StudyFacts<'_>) -> Collected {
    for kind in [PhaseKind::Shape, PhaseKind::Pose] {
        if collected.phases.contains(&kind)
            && let Some(reason) = unpredicted(kind, &collected, facts)
        {
            collected.phases.retain(|planned| *planned != kind);
            collected.skip(Subject::Phase(kind), reason);
        }
    }
    let are_shapes_predicted = collected.phases.contains(&PhaseKind::Shape);
    for fit in std::mem::take(&mut collected.fits) {
        let is_read = collected
            .metrics
            .iter()
            .any(|metric| metric.fields.contains(fit.field))
            || (are_shapes_predicted && fit.field == Field::Prediction);
        match (is_read, facts.model) {
            (true, ModelChoice::Finished) => {
                let reason = PlanReason::Skip(SkipReason::AlreadyThere);
                collected.skip(Subject::Fit(fit.field), reason);
            }
            (true, _) => collected.fits.push(fit),
            (false, _) => collected.skip(Subject::Fit(fit.field), PlanReason::NoMetricNeeds),
        }
    }
    for kind in std::mem::take(&mut collected.phases) {
        let metric = collected.metrics.iter().any(|metric| metric.phase == kind);
        let fit = collected.fits.iter().any(|fit: &Fit| fit.phase == kind);
        // A task is not a metric. The scene requests its presses.
        if metric || fit || kind.is_of_task() {
            collected.phases.push(kind);
        } else {
            collected.skip(Subject::Phase(kind), PlanReason::NoMetricNeeds);
        }
    }
    let phases = &collected.phases;
    for press in &mut collected.presses {
        press.phases.retain(|kind| phases.contains(kind));
    }
    collected.presses.retain(|press| !press.phases.is_empty());
    collected
}

/// Reason why no model predicts the presses of the task `kind`; `None` if a model predicts them. Shapes are predicted by the model of the study.
/// Changes of pose are predicted by a model that is fitted to them.
fn unpredicted(
    kind: PhaseKind,
    collected: &Collected,
    facts: &StudyFacts<'_>,
) -> Option<PlanReason> {
    let field = Field::Prediction;
    // A field that no metric needs still has a source.
    if let Some(reason @ PlanReason::Unresolved { .. }) =
        collected.reason_of(&Subject::Field(field))
    {
        return Some(reason.clone());
    }
    let is_fitted = kind != PhaseKind::Pose || facts.model != ModelChoice::Finished;
    (!is_fitted).then_some(PlanReason::Unresolved {
        field,
        cause: Cause::NoEstimator,
    })
}
