//! Held-out presses of the ball at several depths, whose contact shape is predicted.

use super::{DepthPart, PhaseInputs, straight};
use crate::phase_kind::PhaseKind;
use crate::press::{Motion, Press};

/// One press for each point, straight to several depths. The depths increase, and each depth is drawn from its own part of the range.
pub(super) fn presses(inputs: &PhaseInputs<'_>) -> Vec<Press> {
    let draws = inputs.draws(PhaseKind::Shape);
    let spec = &inputs.protocol.shape;
    let parts = spec.depths.value;
    (0..u64::from(spec.presses.value))
        .map(|point| {
            let waypoints = (0..parts).map(|index| {
                let part = DepthPart {
                    point,
                    index,
                    parts,
                };
                straight(inputs.depth(draws, spec.depth_min_mm.value, part))
            });
            let motion = Motion::Indent(waypoints.collect());
            inputs.press(draws.place(&inputs.footprint, point), motion)
        })
        .collect()
}
