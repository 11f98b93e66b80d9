//! Held-out presses all over the surface, for an error map. No model is fitted on them.

use taceva_core::Phase;

use super::{DepthPart, PhaseInputs, straight};
use crate::phase_kind::PhaseKind;
use crate::press::{Motion, Press, Waypoint};

/// One press for each point, to its own depth, first straight and then sheared.
pub(super) fn presses(inputs: &PhaseInputs<'_>) -> Vec<Press> {
    (0..u64::from(inputs.protocol.spatial.points.value))
        .map(|point| press(inputs, point))
        .collect()
}

/// Held-out press number `point`.
pub(super) fn press(inputs: &PhaseInputs<'_>, point: u64) -> Press {
    let draws = inputs.draws(PhaseKind::Spatial);
    let spec = &inputs.protocol.spatial;
    let part = DepthPart {
        point,
        index: 0,
        parts: 1,
    };
    let depth = inputs.depth(draws, spec.depth_min_mm.value, part);
    let shear_mm = spec.shear_mm.value;
    let sheared = (shear_mm > 0.0).then(|| Waypoint {
        depth,
        shear: inputs.shear(draws, shear_mm, part),
        phase: Phase::Load,
    });
    let waypoints = [Some(straight(depth)), sheared];
    let motion = Motion::Indent(waypoints.into_iter().flatten().collect());
    inputs.press(draws.place(&inputs.footprint, point), motion)
}
