//! Pass 6: the gate. It removes nothing; a plan that would do the impossible does not leave it.

use std::collections::BTreeSet;

use taceva_core::Nanometre;

use super::draft::{Draft, PlannedPress};
use super::facts::StudyFacts;
use crate::phase::PhaseKind;
use crate::scene::SceneProblem;

/// The most presses of one plan: at ten seconds a press, four months without a pause.
const GREATEST_PRESSES: u64 = 1_000_000;

/// Refuses a protocol of more presses than can be drawn, before any is.
pub(super) fn is_drawable(facts: &StudyFacts<'_>) -> Result<(), SceneProblem> {
    let Some(ground) = &facts.ground else {
        return Ok(());
    };
    let found = PhaseKind::ALL
        .into_iter()
        .map(|kind| ground.count(kind))
        .sum();
    if found <= GREATEST_PRESSES {
        return Ok(());
    }
    Err(SceneProblem::TooManyPresses {
        found,
        greatest: GREATEST_PRESSES,
    })
}

/// Lets `draft` through if every need is met, no press comes twice, and none leaves the limits or the surface.
pub(super) fn pass(draft: Draft, facts: &StudyFacts<'_>) -> Result<Draft, SceneProblem> {
    match fault(&draft, facts) {
        Some(fault) => Err(SceneProblem::Contradiction(fault)),
        None => Ok(draft),
    }
}

fn fault(draft: &Draft, facts: &StudyFacts<'_>) -> Option<String> {
    let ids: BTreeSet<_> = draft.presses.iter().map(|press| press.id).collect();
    if ids.len() != draft.presses.len() {
        return Some("two presses of the plan have one name".to_owned());
    }
    let unmet = draft.metrics.iter().find_map(|metric| {
        let absent = metric
            .fields
            .iter()
            .find(|field| !draft.fields.contains(*field));
        let pressed = facts.is_recording() || draft.phases.contains(&metric.phase);
        match (absent, pressed) {
            (Some(field), _) => Some(format!(
                "`{}` reads `{field}`, which the plan left out",
                metric.id
            )),
            (None, false) => Some(format!(
                "`{}` needs {}, which the plan left out",
                metric.id, metric.phase
            )),
            (None, true) => None,
        }
    });
    unmet.or_else(|| {
        let ground = facts.ground.as_ref()?;
        let beyond = |press: &&PlannedPress| {
            let [x, y] = press.press.place;
            let too_deep = |depth: Nanometre| depth > ground.depth_max;
            let mut stations = press.press.stations().iter();
            !ground.footprint.contains(x, y) || stations.any(|station| too_deep(station.depth))
        };
        let press = draft.presses.iter().find(beyond)?;
        Some(format!(
            "press {} leaves the surface or the depth limit",
            press.id
        ))
    })
}
