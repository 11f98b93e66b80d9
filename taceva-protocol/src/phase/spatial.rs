//! Held-out presses all over the surface: where errors are large, no model has seen them.

use taceva_core::Phase;

use super::{DepthPart, Ground, PhaseKind, straight};
use crate::press::{Motion, Press, Station};

/// One visit a point at a depth of its own, straight and then sheared.
pub(super) fn presses(ground: &Ground<'_>) -> Vec<Press> {
    (0..u64::from(ground.protocol.spatial.points.value))
        .map(|point| press(ground, point))
        .collect()
}

/// The held-out press number `point`.
pub(super) fn press(ground: &Ground<'_>, point: u64) -> Press {
    let draws = ground.draws(PhaseKind::Spatial);
    let spec = &ground.protocol.spatial;
    let part = DepthPart {
        point,
        index: 0,
        parts: 1,
    };
    let depth = ground.depth(draws, spec.depth_min_mm.value, part);
    let shear_mm = spec.shear_mm.value;
    let sheared = (shear_mm > 0.0).then(|| Station {
        depth,
        shear: ground.shear(draws, shear_mm, part),
        phase: Phase::Load,
    });
    let stations = [Some(straight(depth)), sheared];
    let motion = Motion::Indent(stations.into_iter().flatten().collect());
    ground.press(draws.place(&ground.footprint, point), motion)
}
