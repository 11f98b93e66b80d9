//! Fault of pictures: lamps or exposure that fade during the recording.

use crate::fault::{Effect, Fault, Scope};

pub(super) static FAULT: Fault = Fault {
    id: "exposure_drift",
    title: "the picture darkens linearly in time, from no loss at the first sample to the full loss at the last",
    parameter: "share of the light that is lost at the end",
    scope: Scope::Fixed,
    table: [0.03, 0.07, 0.15, 0.25, 0.40],
    most: 1.0,
    note: None,
    effect: Effect::Growing(super::exposure_low::apply),
};
