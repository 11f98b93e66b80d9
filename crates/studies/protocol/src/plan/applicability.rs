//! Pass 2: selects the metrics that apply to this sensor, for all or some channels.

use taceva_core::{Field, SkipReason};

use super::collect::{Collected, PlannedMetric};
use super::study_facts::StudyFacts;
use crate::phase_kind::PhaseKind;
use crate::reason::{PlanReason, Subject};

/// Removes metrics that are not requested or do not apply, and channels that a metric cannot use.
pub(super) fn pass(mut collected: Collected, facts: &StudyFacts<'_>) -> Collected {
    for mut metric in std::mem::take(&mut collected.metrics) {
        if let Some(reason) = obstacle(&metric, &collected, facts) {
            collected.skip(Subject::Metric(metric.id), reason);
            continue;
        }
        metric
            .channels
            .retain(|name| collected.channels.contains(name));
        narrow_shear(&mut metric, &mut collected, facts);
        collected.metrics.push(metric);
    }
    collected
}

/// Reason why `metric` cannot be computed; `None` if it applies.
fn obstacle(
    metric: &PlannedMetric,
    collected: &Collected,
    facts: &StudyFacts<'_>,
) -> Option<PlanReason> {
    let wanted = facts.wanted.as_ref();
    if wanted.is_some_and(|wanted| !wanted.contains(&metric.id.as_str())) {
        return Some(PlanReason::Skip(SkipReason::NotWanted));
    }
    let about_light = metric.phase == PhaseKind::LightSweep;
    if about_light && facts.opaque == Some(true) {
        return Some(PlanReason::Skip(SkipReason::GelIsOpaque));
    }
    let needs_pictures = metric.phase == PhaseKind::Idle && !facts.is_recording();
    if needs_pictures && let Some(reason) = collected.reason_of(&Subject::Field(Field::Frame)) {
        return Some(reason.clone());
    }
    let absent_field = metric
        .fields
        .iter()
        .find(|field| !collected.fields.contains(*field));
    if let Some(field) = absent_field {
        let absent = || PlanReason::Skip(SkipReason::FieldAbsent(field));
        let known = collected.reason_of(&Subject::Field(field)).cloned();
        return Some(known.unwrap_or_else(absent));
    }
    let absent_channel = metric
        .required
        .iter()
        .find(|name| !collected.channels.contains(name));
    if let Some(name) = absent_channel {
        let absent = || PlanReason::Skip(SkipReason::ChannelAbsent(name.clone()));
        let known = collected
            .reason_of(&Subject::Channel(name.clone()))
            .cloned();
        return Some(known.unwrap_or_else(absent));
    }
    if let Some(reason) = metric.facts.iter().find_map(|fact| facts.absent(*fact)) {
        return Some(PlanReason::Skip(reason));
    }
    let is_pressed = |kind| {
        collected
            .presses
            .iter()
            .any(|press| press.phases.contains(&kind))
    };
    let fitted_on = collected
        .fits
        .iter()
        .filter(|fit| metric.fields.contains(fit.field))
        .map(|fit| fit.phase);
    let mut phases = fitted_on.chain([metric.phase]);
    if !facts.is_recording() && !phases.all(is_pressed) {
        return Some(PlanReason::Skip(SkipReason::FactAbsent("footprint")));
    }
    None
}

/// Removes shear channels from metrics of repeatability if the gel has no markers, because its frames do not show shear (TacEva 2025).
fn narrow_shear(metric: &mut PlannedMetric, collected: &mut Collected, facts: &StudyFacts<'_>) {
    let reads_repeats =
        metric.phase == PhaseKind::Repeatability && metric.fields.contains(Field::Prediction);
    if facts.markers != Some(false) || !reads_repeats {
        return;
    }
    let is_shear = |name: &String| ["Fx", "Fy"].contains(&name.as_str());
    let shear: Vec<String> = metric
        .channels
        .iter()
        .filter(|name| is_shear(name))
        .cloned()
        .collect();
    if !shear.is_empty() {
        metric.channels.retain(|name| !is_shear(name));
        let part = format!("{} ({})", metric.id, shear.join(", "));
        collected.skip(Subject::Metric(part), PlanReason::NoMarkers);
    }
}
