//! Frames above the gel without contact. Their time stamps give the frame rate.

use taceva_core::Nanometre;

use super::PhaseInputs;
use crate::press::{Motion, Press};

/// One press above the centre, in the light scene of calibration.
pub(super) fn presses(inputs: &PhaseInputs<'_>) -> Vec<Press> {
    let frames = inputs.protocol.idle.frames.value;
    vec![inputs.press([Nanometre(0); 2], Motion::Rest { frames })]
}
