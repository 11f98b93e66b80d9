//! Sensors that meet the needs but have no rank, because they were tested with other faults.

use super::{Dropped, Need, Property};
use crate::catalogue::Sensor;
use crate::faults::FaultList;

/// Removes sensors from `remaining` and returns them, if a need ranks by faults and the lists of faults differ. The list that most sensors have
/// stays; of several, that of the first sensor.
pub(super) fn take_apart(remaining: &mut Vec<&Sensor>, needs: &[Need]) -> Vec<Dropped> {
    let mut ranks = needs.iter().flat_map(|need| &need.ranks);
    let ranks_by_faults =
        ranks.any(|property| matches!(property, Property::Degradation(_) | Property::SkillEnd(_)));
    let lists: Vec<&FaultList> = remaining.iter().filter_map(list).collect();
    let count = |list: &FaultList| {
        let same = lists.iter().filter(|other| other.digest == list.digest);
        same.count()
    };
    // Reversed, because of equal counts the last is taken.
    let most = lists.iter().copied().rev().max_by_key(|list| count(list));
    let Some(kept) = most.filter(|_| ranks_by_faults) else {
        return Vec::new();
    };
    let mut apart = Vec::new();
    remaining.retain(|sensor| match list(sensor) {
        Some(own) if own.digest != kept.digest => {
            apart.push(Dropped {
                name: sensor.name.clone(),
                reason: format!(
                    "its faults are {}, and ranked sensors have {}: run `taceva stress` with the same --faults, --severity, --by and --draws",
                    shown(own),
                    shown(kept)
                ),
            });
            false
        }
        _ => true,
    });
    apart
}

fn list<'a>(sensor: &&'a Sensor) -> Option<&'a FaultList> {
    Some(&sensor.faults.as_ref()?.list)
}

/// Name of the list with the start of its digest, because lists of other severities have the same name.
fn shown(list: &FaultList) -> String {
    let digest: String = list.digest.chars().take(8).collect();
    format!("`{}` ({digest})", taceva_core::shown(&list.name))
}
