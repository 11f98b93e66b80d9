//! Pass 5: what nobody reads is not recorded, and pictures nobody looks at are not taken.

use taceva_core::{Field, FieldSet};

use super::draft::{Draft, PlannedMetric, SURFACE};
use super::facts::StudyFacts;
use super::reason::{PlanReason, Subject};
use crate::phase::PhaseKind;

/// Removes fields that no kept metric or model reads, and the pictures of presses that none looks at.
pub(super) fn pass(mut draft: Draft, facts: &StudyFacts<'_>) -> Draft {
    let of_metrics = draft.metrics.iter().map(|metric| metric.fields);
    let read = of_metrics.fold(FieldSet::EMPTY, |all, fields| all | fields);
    let seen = draft
        .phases
        .iter()
        .any(|kind| draft.looks_at_pictures(*kind));
    let of_models = [Field::Prediction, Field::PredictedSpacing];
    let predicted = of_models.into_iter().any(|field| read.contains(field));
    let needed = match (
        seen || predicted || !draft.fits.is_empty(),
        draft.metrics.is_empty(),
    ) {
        (true, _) => read.with(Field::Frame).with(Field::Point),
        (false, false) => read.with(Field::Point),
        (false, true) => read,
    };
    let needed = match draft.phases.contains(&PhaseKind::Idle) {
        true => needed.with(Field::Stamp),
        false => needed,
    };
    for field in draft.fields.iter().collect::<Vec<Field>>() {
        if !needed.contains(field) {
            draft.fields = draft.fields.without(field);
            draft.skip(Subject::Field(field), PlanReason::NoMetricNeeds);
        }
    }
    let feels = |metric: &PlannedMetric| metric.phase == PhaseKind::SurfaceMap;
    if !facts.is_recording()
        && draft.channels.iter().any(|name| name == SURFACE)
        && !draft.metrics.iter().any(feels)
    {
        draft.channels.retain(|name| name != SURFACE);
        let height = Subject::Channel(SURFACE.to_owned());
        draft.skip(height, PlanReason::NoMetricNeeds);
    }
    let seen: Vec<_> = draft
        .phases
        .iter()
        .copied()
        .filter(|kind| draft.looks_at_pictures(*kind))
        .collect();
    for press in &mut draft.presses {
        press.frames &= press.phases.iter().any(|kind| seen.contains(kind));
    }
    draft
}
