//! How much of the light a grating takes away.

use crate::parameters::Parameters;

/// A grating's contrast as a part of the light, from its contrast over the noise of a pixel as parameters state it.
pub(super) fn grating_contrast(parameters: &Parameters) -> f64 {
    let camera = &parameters.camera;
    let variance = camera.shot_gain * camera.mean_gray + camera.read_noise * camera.read_noise;
    parameters.gratings.contrast * variance.sqrt() / camera.mean_gray.max(1.0)
}
