//! Fault in which the lamps of the left side dim.

use crate::canvas::{Canvas, Realisation};
use crate::fault::{Effect, Fault, Scope};

pub(super) static FAULT: Fault = Fault {
    id: "led_loss",
    title: "the lamps of the left side dim, linearly across the picture",
    parameter: "share of the light that is lost at the left edge",
    scope: Scope::Fixed,
    table: [0.03, 0.07, 0.15, 0.30, 0.50],
    most: 1.0,
    note: None,
    effect: Effect::Numbers(apply),
};

fn apply(canvas: &mut Canvas, drawn: &Realisation) {
    let (colours, steps) = (canvas.colours(), canvas.width().saturating_sub(1).max(1));
    for row in canvas.rows() {
        for (x, pixel) in row.chunks_exact_mut(colours).enumerate() {
            let kept = 1.0 - drawn.parameter * (1.0 - x as f32 / steps as f32);
            pixel.iter_mut().for_each(|value| *value *= kept);
        }
    }
}
