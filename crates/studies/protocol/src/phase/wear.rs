//! Load cycles that wear the gel before the measured presses of a stage of wear.

use taceva_core::Nanometre;

use super::{PhaseInputs, nanometres};
use crate::press::{LoadCycle, Motion, Press};
use crate::scene::{WearLoad, WearSpec, WearStage};

/// Converts a force in N that was checked during parsing.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a force of a scene is above 0 and at most 1000 N"
)]
fn micronewtons(newtons: f64) -> u32 {
    (newtons * 1e6).round() as u32
}

/// The cycles of `stage` in the middle of the sensing area; a stroke of abrasion is centred there.
pub(super) fn presses(
    inputs: &PhaseInputs<'_>,
    load: WearLoad,
    spec: &WearSpec,
    stage: &WearStage,
) -> Vec<Press> {
    let travel = nanometres(spec.travel_mm());
    let cycle = LoadCycle {
        load,
        force: micronewtons(spec.force_n.value),
        travel,
    };
    let start = match load {
        WearLoad::Abrasion => Nanometre(-(travel.0 / 2)),
        WearLoad::Compression | WearLoad::Shear => Nanometre(0),
    };
    let press = inputs.press([start, Nanometre(0)], Motion::Load(cycle));
    (0..stage.added)
        .map(|cycle| Press {
            repeat: Some(cycle),
            ..press.clone()
        })
        .collect()
}
