//! Presses for fitting and testing a model: points all over the surface, each pressed to several depths, first straight and then sheared.

use taceva_core::Phase;

use super::{DepthPart, PhaseInputs, straight};
use crate::phase_kind::PhaseKind;
use crate::press::{Motion, Press, Waypoint};

/// One press for each point. Its depths increase, and each depth is drawn from its own part of the range.
pub(super) fn presses(inputs: &PhaseInputs<'_>) -> Vec<Press> {
    let draws = inputs.draws(PhaseKind::Calibration);
    let spec = &inputs.protocol.calibration;
    let parts = spec.indentations.value;
    let shear_mm = spec.shear_mm.value;
    (0..u64::from(spec.points.value))
        .map(|point| {
            let waypoints = (0..parts).flat_map(|index| {
                let part = DepthPart {
                    point,
                    index,
                    parts,
                };
                let depth = inputs.depth(draws, spec.depth_min_mm.value, part);
                let sheared = (shear_mm > 0.0).then(|| Waypoint {
                    depth,
                    shear: inputs.shear(draws, shear_mm, part),
                    phase: Phase::Load,
                });
                [Some(straight(depth)), sheared].into_iter().flatten()
            });
            let motion = Motion::Indent(waypoints.collect());
            inputs.press(draws.place(&inputs.footprint, point), motion)
        })
        .collect()
}
