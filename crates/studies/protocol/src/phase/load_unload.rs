//! Loading and unloading in equal steps, for the hysteresis of the gel.

use taceva_core::Phase;

use super::{PhaseInputs, straight};
use crate::phase_kind::PhaseKind;
use crate::press::{Motion, Press, Waypoint};

/// One press at each point. The deepest waypoint belongs to both branches and is visited once for each.
pub(super) fn presses(inputs: &PhaseInputs<'_>) -> Vec<Press> {
    let draws = inputs.draws(PhaseKind::LoadUnload);
    let spec = &inputs.protocol.hysteresis;
    let depths = inputs.staircase(spec.depth_step_mm.value);
    let load = depths.iter().copied().map(straight);
    let unload = depths.iter().rev().map(|depth| Waypoint {
        phase: Phase::Unload,
        ..straight(*depth)
    });
    let waypoints: Vec<Waypoint> = load.chain(unload).collect();
    (0..u64::from(spec.points.value))
        .map(|point| {
            let place = draws.place(&inputs.footprint, point);
            inputs.press(place, Motion::Indent(waypoints.clone()))
        })
        .collect()
}
