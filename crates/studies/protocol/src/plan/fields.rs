//! Pass 5: removes fields and frames that nothing reads.

use taceva_core::{Field, FieldSet};

use super::collect::{Collected, PlannedMetric, SURFACE};
use super::study_facts::StudyFacts;
use crate::phase_kind::PhaseKind;
use crate::reason::{PlanReason, Subject};

/// Removes fields that no planned metric or model reads, and frames of presses whose phases read no frames. Loading and unloading keep their frames
/// if the scene requests their predictions.
pub(super) fn pass(mut collected: Collected, facts: &StudyFacts<'_>) -> Collected {
    let of_metrics = collected.metrics.iter().map(|metric| metric.fields);
    let read = of_metrics.fold(FieldSet::EMPTY, |all, fields| all | fields);
    let seen = collected
        .phases
        .iter()
        .any(|kind| collected.looks_at_pictures(*kind));
    let of_models = [Field::Prediction, Field::PredictedSpacing];
    let predicted = of_models.into_iter().any(|field| read.contains(field));
    let needed = match (
        seen || predicted || !collected.fits.is_empty(),
        collected.metrics.is_empty(),
    ) {
        (true, _) => read.with(Field::Frame).with(Field::Point),
        (false, false) => read.with(Field::Point),
        (false, true) => read,
    };
    let needed = match collected.phases.contains(&PhaseKind::Idle) {
        true => needed.with(Field::Stamp),
        false => needed,
    };
    let needed = match collected.phases.iter().any(|kind| kind.is_of_task()) {
        true => needed.with(Field::Truth),
        false => needed,
    };
    let needed = match collected.phases.contains(&PhaseKind::Shape) {
        true => needed.with(Field::Prediction),
        false => needed,
    };
    let inputs = facts.phase_inputs.as_ref();
    let are_units_compared = collected.phases.contains(&PhaseKind::Repeatability)
        && inputs.is_some_and(|inputs| inputs.protocol.repeatability.every_unit.value);
    let needed = match are_units_compared {
        true => needed.with(Field::UnitId),
        false => needed,
    };
    for field in collected.fields.iter().collect::<Vec<Field>>() {
        if !needed.contains(field) {
            collected.fields = collected.fields.without(field);
            collected.skip(Subject::Field(field), PlanReason::NoMetricNeeds);
        }
    }
    let feels = |metric: &PlannedMetric| metric.phase == PhaseKind::SurfaceMap;
    if !facts.is_recording()
        && collected.channels.iter().any(|name| name == SURFACE)
        && !collected.metrics.iter().any(feels)
    {
        collected.channels.retain(|name| name != SURFACE);
        let height = Subject::Channel(SURFACE.to_owned());
        collected.skip(height, PlanReason::NoMetricNeeds);
    }
    let are_branches_predicted =
        predicted && inputs.is_some_and(|inputs| inputs.protocol.hysteresis.predicted.value);
    let seen: Vec<_> = collected
        .phases
        .iter()
        .copied()
        .filter(|kind| {
            let is_branch = *kind == PhaseKind::LoadUnload && are_branches_predicted;
            is_branch || collected.looks_at_pictures(*kind)
        })
        .collect();
    for press in &mut collected.presses {
        press.frames &= press.phases.iter().any(|kind| seen.contains(kind));
    }
    collected
}
