//! View of a camera.

use super::ambient::AmbientLight;
use super::stimulus::Stimulus;

/// View of the camera in one picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct View {
    /// Stimulus of the gel.
    pub stimulus: Stimulus,
    /// Ambient light.
    pub light: AmbientLight,
    /// Number of the press. It sets random effects in the gel.
    pub press: u64,
    /// Number of the picture in that press. It sets the noise of the camera.
    pub picture: u32,
}
