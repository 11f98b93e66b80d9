//! Pictures from above the gel, touching nothing: the frame rate is in their stamps.

use taceva_core::Nanometre;

use super::PhaseInputs;
use crate::press::{Motion, Press};

/// One visit above the centre, in the light of calibration.
pub(super) fn presses(inputs: &PhaseInputs<'_>) -> Vec<Press> {
    let frames = inputs.protocol.idle.frames.value;
    vec![inputs.press([Nanometre(0); 2], Motion::Rest { frames })]
}
