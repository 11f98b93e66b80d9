//! Into the gel step by step and out again by the same steps: what the gel keeps of the work done on it.

use taceva_core::Phase;

use super::{Ground, PhaseKind, straight};
use crate::press::{Motion, Press, Station};

/// One visit a point; the deepest station belongs to both branches and is visited once for each.
pub(super) fn presses(ground: &Ground<'_>) -> Vec<Press> {
    let draws = ground.draws(PhaseKind::LoadUnload);
    let spec = &ground.protocol.hysteresis;
    let depths = ground.staircase(spec.depth_step_mm.value);
    let load = depths.iter().copied().map(straight);
    let unload = depths.iter().rev().map(|depth| Station {
        phase: Phase::Unload,
        ..straight(*depth)
    });
    let stations: Vec<Station> = load.chain(unload).collect();
    (0..u64::from(spec.points.value))
        .map(|point| {
            let place = draws.place(&ground.footprint, point);
            ground.press(place, Motion::Indent(stations.clone()))
        })
        .collect()
}
