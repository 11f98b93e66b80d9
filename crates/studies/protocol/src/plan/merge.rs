//! Pass 4: merges equal presses, and sorts presses to minimise changes of unit, specimen and light.

use std::collections::BTreeMap;

use super::collect::{Collected, PlannedPress};
use super::study_facts::StudyFacts;
use crate::content_id::ContentId;
use crate::phase_kind::PhaseKind;
use crate::reason::{PlanReason, Subject};
use taceva_core::Specimen;

/// Merges equal presses and sorts the resulting list.
pub(super) fn pass(mut collected: Collected, facts: &StudyFacts<'_>) -> Collected {
    let mut places: BTreeMap<ContentId, usize> = BTreeMap::new();
    let mut shared: BTreeMap<(PhaseKind, PhaseKind), usize> = BTreeMap::new();
    let mut presses: Vec<PlannedPress> = Vec::with_capacity(collected.presses.len());
    for press in std::mem::take(&mut collected.presses) {
        match places.get(&press.id) {
            Some(&place) => {
                let first: &mut PlannedPress = &mut presses[place];
                for kind in press.phases {
                    *shared.entry((kind, first.phases[0])).or_default() += 1;
                    first.phases.push(kind);
                }
                first.phases.sort_unstable();
                first.phases.dedup();
                first.frames |= press.frames;
            }
            None => {
                places.insert(press.id, presses.len());
                presses.push(press);
            }
        }
    }
    for ((kind, phase), presses) in shared {
        collected.skip(
            Subject::Phase(kind),
            PlanReason::VisitedBy { phase, presses },
        );
    }
    let unit_of = |press: &PlannedPress| {
        facts
            .units
            .iter()
            .position(|unit| *unit == press.press.unit)
    };
    let light_of = |press: &PlannedPress| {
        let name = press.press.light.as_ref()?;
        facts.lights.iter().position(|light| light == name)
    };
    // The sort is stable, so equal keys keep the order of their phase.
    presses.sort_by_key(|press| {
        let board = match press.press.specimen {
            Specimen::Sphere { .. } => None,
            Specimen::Grating { kind, spacing } => Some((kind, spacing)),
        };
        (unit_of(press), board, light_of(press), press.phases[0])
    });
    collected.presses = presses;
    collected
}
