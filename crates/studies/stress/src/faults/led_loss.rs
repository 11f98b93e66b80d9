//! Fault in which the lamps of one side dim.

use taceva_dataset::{Leds, PictureSide};

use crate::canvas::{Canvas, Realisation};
use crate::fault::{Effect, Fault, Scope};

pub(super) static FAULT: Fault = Fault {
    id: "led_loss",
    title: "the lamps of the left side, or of the stated side, dim linearly across the picture",
    parameter: "share of the light that is lost at the edge of that side",
    scope: Scope::Fixed,
    table: [0.03, 0.07, 0.15, 0.30, 0.50],
    most: 1.0,
    note: None,
    effect: Effect::Leds(apply),
};

/// Dims the colours whose LEDs are on the lost side. If no side is known, dims all colours from the left.
fn apply(canvas: &mut Canvas, drawn: &Realisation, leds: Leds) {
    let lost = lost_side(leds);
    let is_lost = leds.sides().map(|side| side == lost);
    let colours = canvas.colours();
    let [right, bottom] = [canvas.width(), canvas.height()].map(|size| size.saturating_sub(1));
    for (y, row) in canvas.rows().enumerate() {
        for (x, pixel) in row.chunks_exact_mut(colours).enumerate() {
            let [place, steps] = match lost {
                None | Some(PictureSide::Left) => [x, right],
                Some(PictureSide::Right) => [right - x, right],
                Some(PictureSide::Top) => [y, bottom],
                Some(PictureSide::Bottom) => [bottom - y, bottom],
            };
            let kept = 1.0 - drawn.parameter * (1.0 - place as f32 / steps.max(1) as f32);
            for (value, _) in pixel.iter_mut().zip(is_lost).filter(|(_, lost)| *lost) {
                *value *= kept;
            }
        }
    }
}

/// Side whose LEDs dim: the first of left, right, top and bottom with LEDs; `None` if no side is known.
fn lost_side(leds: Leds) -> Option<PictureSide> {
    leds.sides().into_iter().flatten().min()
}

/// Note in the report on the side whose LEDs dim; `None` if no side is known.
pub(crate) fn note_on(leds: Leds) -> Option<String> {
    let side = lost_side(leds)?;
    Some(format!(
        "only the colours that `leds` in [sensor] of the recording states for the {side} side dim, from that side"
    ))
}
