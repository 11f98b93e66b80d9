//! What a model is fitted and tested on: points all over the surface, at each some depths, straight and then sheared.

use taceva_core::Phase;

use super::{DepthPart, Ground, PhaseKind, straight};
use crate::press::{Motion, Press, Station};

/// One visit a point; its depths grow, each drawn from a part of the range of its own.
pub(super) fn presses(ground: &Ground<'_>) -> Vec<Press> {
    let draws = ground.draws(PhaseKind::Calibration);
    let spec = &ground.protocol.calibration;
    let parts = spec.indentations.value;
    let shear_mm = spec.shear_mm.value;
    (0..u64::from(spec.points.value))
        .map(|point| {
            let stations = (0..parts).flat_map(|index| {
                let part = DepthPart {
                    point,
                    index,
                    parts,
                };
                let depth = ground.depth(draws, spec.depth_min_mm.value, part);
                let sheared = (shear_mm > 0.0).then(|| Station {
                    depth,
                    shear: ground.shear(draws, shear_mm, part),
                    phase: Phase::Load,
                });
                [Some(straight(depth)), sheared].into_iter().flatten()
            });
            let motion = Motion::Indent(stations.collect());
            ground.press(draws.place(&ground.footprint, point), motion)
        })
        .collect()
}
