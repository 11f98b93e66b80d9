//! Input of a picture: stimulus, light, and numbers that select noise.

use super::ambient::AmbientLight;
use super::stimulus::Stimulus;

/// Input of the camera for one picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct View {
    /// Object that touches the gel.
    pub stimulus: Stimulus,
    /// Ambient light.
    pub light: AmbientLight,
    /// Number of the press. The number determines random effects in the gel.
    pub press: u64,
    /// Number of the picture in the press. The number determines the noise of the camera.
    pub picture: u32,
}
