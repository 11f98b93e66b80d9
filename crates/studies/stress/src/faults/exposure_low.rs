//! Fault in which a shorter exposure or aged lamps darken the whole picture.

use crate::canvas::{Canvas, Realisation};
use crate::fault::{Effect, Fault, Scope};

pub(super) static FAULT: Fault = Fault {
    id: "exposure_low",
    title: "the whole picture is darker",
    parameter: "share of the light that is lost",
    scope: Scope::Fixed,
    table: [0.03, 0.07, 0.15, 0.25, 0.40],
    most: 1.0,
    note: None,
    effect: Effect::Numbers(apply),
};

pub(super) fn apply(canvas: &mut Canvas, drawn: &Realisation) {
    let kept = 1.0 - drawn.parameter;
    canvas.values.iter_mut().for_each(|value| *value *= kept);
}
