//! Pass 6: rejects a plan that contradicts itself or exceeds its limits. Removes nothing.

use std::collections::BTreeSet;

use taceva_core::Nanometre;

use super::collect::{Collected, PlannedPress};
use super::study_facts::StudyFacts;
use crate::phase_kind::PhaseKind;
use crate::text::SceneProblem;

/// Maximum number of presses in a plan. At ten seconds each, they take four months.
const GREATEST_PRESSES: u64 = 1_000_000;

/// Rejects a protocol with too many presses before any is drawn.
pub(super) fn is_drawable(facts: &StudyFacts<'_>) -> Result<(), SceneProblem> {
    let Some(phase_inputs) = &facts.phase_inputs else {
        return Ok(());
    };
    let found = PhaseKind::ALL
        .into_iter()
        .map(|kind| phase_inputs.count(kind))
        .sum();
    if found <= GREATEST_PRESSES {
        return Ok(());
    }
    Err(SceneProblem::TooManyPresses {
        found,
        greatest: GREATEST_PRESSES,
    })
}

/// Accepts `collected` if every need is fulfilled, press ids are unique, and all presses are within the limits and the surface.
pub(super) fn pass(
    collected: Collected,
    facts: &StudyFacts<'_>,
) -> Result<Collected, SceneProblem> {
    match fault(&collected, facts) {
        Some(fault) => Err(SceneProblem::Contradiction(fault)),
        None => Ok(collected),
    }
}

fn fault(collected: &Collected, facts: &StudyFacts<'_>) -> Option<String> {
    let ids: BTreeSet<_> = collected.presses.iter().map(|press| press.id).collect();
    if ids.len() != collected.presses.len() {
        return Some("two presses of the plan have the same name".to_owned());
    }
    let unmet = collected.metrics.iter().find_map(|metric| {
        let absent = metric
            .fields
            .iter()
            .find(|field| !collected.fields.contains(*field));
        let pressed = facts.is_recording() || collected.phases.contains(&metric.phase);
        match (absent, pressed) {
            (Some(field), _) => Some(format!(
                "`{}` reads `{field}`, which the plan does not record",
                metric.id
            )),
            (None, false) => Some(format!(
                "`{}` needs {}, which the plan omits",
                metric.id, metric.phase
            )),
            (None, true) => None,
        }
    });
    unmet.or_else(|| {
        let phase_inputs = facts.phase_inputs.as_ref()?;
        let beyond = |press: &&PlannedPress| {
            let [x, y] = press.press.place;
            let too_deep = |depth: Nanometre| depth > phase_inputs.depth_max;
            let mut waypoints = press.press.waypoints().iter();
            !phase_inputs.footprint.contains(x, y)
                || waypoints.any(|waypoint| too_deep(waypoint.depth))
        };
        let press = collected.presses.iter().find(beyond)?;
        Some(format!(
            "press {} is outside the footprint or deeper than its limit",
            press.id
        ))
    })
}
