//! Pass 3: removes phases and models that no planned metric needs.

use taceva_core::SkipReason;

use super::collect::{Collected, Fit};
use super::study_facts::{ModelChoice, StudyFacts};
use crate::phase_kind::PhaseKind;
use crate::reason::{PlanReason, Subject};

/// Removes models that no metric reads, then phases that no metric or model uses.
pub(super) fn pass(mut collected: Collected, facts: &StudyFacts<'_>) -> Collected {
    for fit in std::mem::take(&mut collected.fits) {
        let is_read = collected
            .metrics
            .iter()
            .any(|metric| metric.fields.contains(fit.field));
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
        // Slip is no metric: the scene asks for its strokes.
        if metric || fit || kind == PhaseKind::Slip {
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
