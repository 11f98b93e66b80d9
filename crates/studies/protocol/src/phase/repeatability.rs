//! Repeated presses at the same points, to measure the spread of equal presses.

use taceva_core::{Nanometre, Phase};

use super::{PhaseInputs, nanometres, straight};
use crate::phase_kind::PhaseKind;
use crate::press::{Motion, Press, Waypoint};

/// Presses to every depth at each point, trial by trial, on the first unit or on every unit. If the gel has markers, a trial ends with
/// a shear at the greatest depth.
pub(super) fn presses(inputs: &PhaseInputs<'_>) -> Vec<Press> {
    let draws = inputs.draws(PhaseKind::Repeatability);
    let spec = &inputs.protocol.repeatability;
    let depths = inputs.staircase(spec.depth_step_mm.value);
    let shear_mm = spec.shear_mm.value;
    let sheared = depths.last().filter(|_| inputs.markers && shear_mm > 0.0);
    let sheared = sheared.map(|depth| Waypoint {
        depth: *depth,
        shear: [nanometres(shear_mm), Nanometre(0)],
        phase: Phase::Load,
    });
    let waypoints: Vec<Waypoint> = depths
        .iter()
        .copied()
        .map(straight)
        .chain(sheared)
        .collect();
    let units = match spec.every_unit.value {
        true => inputs.units,
        false => &inputs.units[..1],
    };
    let mut presses = Vec::new();
    for unit in units {
        for point in 0..u64::from(spec.points.value) {
            let place = draws.place(&inputs.footprint, point);
            presses.extend((0..spec.trials.value).map(|trial| Press {
                unit: unit.clone(),
                repeat: Some(trial),
                ..inputs.press(place, Motion::Indent(waypoints.clone()))
            }));
        }
    }
    presses
}
