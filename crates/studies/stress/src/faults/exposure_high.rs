//! Fault of pictures: a longer exposure, or more gain.

use crate::canvas::{Canvas, Realisation};
use crate::fault::{Effect, Fault, Scope};

pub(super) static FAULT: Fault = Fault {
    id: "exposure_high",
    title: "the whole picture is brighter, and clipped at full scale",
    parameter: "added light, share of the original light",
    scope: Scope::Fixed,
    table: [0.1, 0.25, 0.5, 1.0, 2.0],
    most: 15.0,
    note: None,
    effect: Effect::Numbers(apply),
};

fn apply(canvas: &mut Canvas, drawn: &Realisation) {
    let gain = 1.0 + drawn.parameter;
    canvas.values.iter_mut().for_each(|value| *value *= gain);
}
