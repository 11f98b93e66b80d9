//! Pictures from above the gel, touching nothing: the frame rate is in their stamps.

use taceva_core::Nanometre;

use super::Ground;
use crate::press::{Motion, Press};

/// One visit above the centre, in the light of calibration.
pub(super) fn presses(ground: &Ground<'_>) -> Vec<Press> {
    let frames = ground.protocol.idle.frames.value;
    vec![ground.press([Nanometre(0); 2], Motion::Rest { frames })]
}
