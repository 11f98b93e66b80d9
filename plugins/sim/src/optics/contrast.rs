//! Contrast of a grating in the light.

use crate::parameters::Parameters;

/// Contrast of a grating relative to the light. The parameter states the contrast relative to the noise of a pixel.
pub(super) fn grating_contrast(parameters: &Parameters) -> f64 {
    let camera = &parameters.camera;
    let variance = camera.shot_gain * camera.mean_gray + camera.read_noise * camera.read_noise;
    parameters.gratings.contrast * variance.sqrt() / camera.mean_gray.max(1.0)
}
