//! The height of the surface, felt at the same points on every unit: how far units of one model differ.

use super::{Ground, PhaseKind};
use crate::press::{Motion, Press};

/// Unit after unit, because units are exchanged by hand.
pub(super) fn presses(ground: &Ground<'_>) -> Vec<Press> {
    let draws = ground.draws(PhaseKind::SurfaceMap);
    let points = u64::from(ground.protocol.surface.points.value);
    let units = ground.units.iter();
    units
        .flat_map(|unit| {
            (0..points).map(move |point| Press {
                unit: unit.clone(),
                ..ground.press(draws.place(&ground.footprint, point), Motion::Touch)
            })
        })
        .collect()
}
