//! The first held-out presses again in every scene of light; in that of calibration they are the held-out presses themselves.

use super::{Ground, spatial};
use crate::press::Press;

/// Scene after scene, because a light takes time to become steady; none where the light cannot be set.
pub(super) fn presses(ground: &Ground<'_>) -> Vec<Press> {
    let points = u64::from(ground.protocol.lighting.points.value);
    let lights = ground.lights.iter();
    lights
        .flat_map(|light| {
            (0..points).map(move |point| Press {
                light: Some(light.clone()),
                ..spatial::press(ground, point)
            })
        })
        .collect()
}
