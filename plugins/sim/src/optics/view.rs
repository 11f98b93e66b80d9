//! What a camera looks at.

use super::ambient::AmbientLight;
use super::stimulus::Stimulus;

/// What the camera looks at in one picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct View {
    /// What touches the gel.
    pub stimulus: Stimulus,
    /// The light from outside.
    pub light: AmbientLight,
    /// The press, by number: what happens to the gel by chance belongs to it.
    pub press: u64,
    /// The picture of that press: the camera's noise belongs to it.
    pub picture: u32,
}
