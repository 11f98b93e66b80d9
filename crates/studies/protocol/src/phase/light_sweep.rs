//! Presses that repeat the first held-out presses in every light scene. In the light scene of calibration, they are equal to the held-out presses.

use super::{PhaseInputs, spatial};
use crate::press::Press;

/// Presses ordered by light scene, because a light needs time to settle; empty if the light cannot be set.
pub(super) fn presses(inputs: &PhaseInputs<'_>) -> Vec<Press> {
    let points = u64::from(inputs.protocol.lighting.points.value);
    let lights = inputs.lights.iter();
    lights
        .flat_map(|light| {
            (0..points).map(move |point| Press {
                light: Some(light.clone()),
                ..spatial::press(inputs, point)
            })
        })
        .collect()
}
