//! Pass 3: parts of the protocol and models that no kept metric needs go.

use taceva_core::SkipReason;

use super::draft::{Draft, Fit};
use super::facts::{ModelChoice, StudyFacts};
use super::reason::{PlanReason, Subject};

/// Removes models nobody asks for, then phases that neither a metric nor a model rests on.
pub(super) fn pass(mut draft: Draft, facts: &StudyFacts<'_>) -> Draft {
    for fit in std::mem::take(&mut draft.fits) {
        let is_read = draft
            .metrics
            .iter()
            .any(|metric| metric.fields.contains(fit.field));
        match (is_read, facts.model) {
            (true, ModelChoice::Finished) => {
                let reason = PlanReason::Skip(SkipReason::AlreadyThere);
                draft.skip(Subject::Fit(fit.field), reason);
            }
            (true, _) => draft.fits.push(fit),
            (false, _) => draft.skip(Subject::Fit(fit.field), PlanReason::NoMetricNeeds),
        }
    }
    for kind in std::mem::take(&mut draft.phases) {
        let metric = draft.metrics.iter().any(|metric| metric.phase == kind);
        let fit = draft.fits.iter().any(|fit: &Fit| fit.phase == kind);
        if metric || fit {
            draft.phases.push(kind);
        } else {
            draft.skip(Subject::Phase(kind), PlanReason::NoMetricNeeds);
        }
    }
    let phases = &draft.phases;
    for press in &mut draft.presses {
        press.phases.retain(|kind| phases.contains(kind));
    }
    draft.presses.retain(|press| !press.phases.is_empty());
    draft
}
