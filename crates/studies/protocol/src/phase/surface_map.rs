//! Surface height, measured at the same points on every unit, for the differences between units.

use super::PhaseInputs;
use crate::phase_kind::PhaseKind;
use crate::press::{Motion, Press};

/// Presses ordered by unit, because an operator changes units by hand.
pub(super) fn presses(inputs: &PhaseInputs<'_>) -> Vec<Press> {
    let draws = inputs.draws(PhaseKind::SurfaceMap);
    let points = u64::from(inputs.protocol.surface.points.value);
    let units = inputs.units.iter();
    units
        .flat_map(|unit| {
            (0..points).map(move |point| Press {
                unit: unit.clone(),
                ..inputs.press(draws.place(&inputs.footprint, point), Motion::Touch)
            })
        })
        .collect()
}
