//! Points approached, pressed and left again and again: how far equal presses differ.

use taceva_core::{Nanometre, Phase};

use super::{Ground, PhaseKind, nanometres, straight};
use crate::press::{Motion, Press, Station};

/// Trial after trial at a point, each to every depth; with markers a shear at the greatest depth ends it.
pub(super) fn presses(ground: &Ground<'_>) -> Vec<Press> {
    let draws = ground.draws(PhaseKind::Repeatability);
    let spec = &ground.protocol.repeatability;
    let depths = ground.staircase(spec.depth_step_mm.value);
    let shear_mm = spec.shear_mm.value;
    let sheared = depths.last().filter(|_| ground.markers && shear_mm > 0.0);
    let sheared = sheared.map(|depth| Station {
        depth: *depth,
        shear: [nanometres(shear_mm), Nanometre(0)],
        phase: Phase::Load,
    });
    let stations: Vec<Station> = depths
        .iter()
        .copied()
        .map(straight)
        .chain(sheared)
        .collect();
    (0..u64::from(spec.points.value))
        .flat_map(|point| {
            let place = draws.place(&ground.footprint, point);
            let stations = &stations;
            (0..spec.trials.value).map(move |trial| Press {
                repeat: Some(trial),
                ..ground.press(place, Motion::Indent(stations.clone()))
            })
        })
        .collect()
}
