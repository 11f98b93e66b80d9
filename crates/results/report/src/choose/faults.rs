//! Sensors that meet the needs but have no rank, because they were tested with other faults or severities.

use super::{Dropped, Need, Property};
use crate::catalogue::Sensor;
use crate::faults::FaultResult;
use crate::names::listed;

/// Removes sensors from `remaining` and returns them, if a need ranks by faults and the tested faults or severities differ. Keeps the sensors with
/// the most frequent list of faults, or with the list of the first sensor in a tie.
pub(super) fn take_apart(remaining: &mut Vec<&Sensor>, needs: &[Need]) -> Vec<Dropped> {
    let mut ranks = needs.iter().flat_map(|need| &need.ranks);
    let ranks_by_faults =
        ranks.any(|property| matches!(property, Property::Degradation(_) | Property::SkillEnd(_)));
    let results: Vec<&FaultResult> = remaining.iter().filter_map(result).collect();
    let bases: Vec<String> = results.iter().map(|of| of.basis()).collect();
    let count = |basis: &String| bases.iter().filter(|other| *other == basis).count();
    // Reversed, because `max_by_key` returns the last of equal counts.
    let tested = results.iter().zip(&bases).rev();
    let most = tested.max_by_key(|(_, basis)| count(basis));
    let Some((kept, basis)) = most.filter(|_| ranks_by_faults) else {
        return Vec::new();
    };
    let mut apart = Vec::new();
    remaining.retain(|sensor| match result(sensor) {
        Some(own) if own.basis() != *basis => {
            let reason = format!(
                "its faults are {}, and ranked sensors have {}. Run `taceva stress` with the same --faults, --severity, --by and --draws, and with severities that each sensor reaches. State `leds` in [sensor] of every recording or of none",
                shown(own),
                shown(kept)
            );
            apart.push(Dropped::new(sensor, reason));
            false
        }
        _ => true,
    });
    apart
}

fn result<'a>(sensor: &&'a Sensor) -> Option<&'a FaultResult> {
    sensor.faults.as_ref()
}

/// Name of the fault list, start of its digest, and untested faults. Lists that differ only in severities have the same name.
fn shown(result: &FaultResult) -> String {
    let list = &result.list;
    let digest: String = list.digest.chars().take(8).collect();
    let list = format!("`{}` ({digest})", taceva_core::shown(&list.name));
    match result.untested().as_slice() {
        [] => list,
        untested => format!("{list} without {}", taceva_core::shown(&listed(untested))),
    }
}
