//! Fault in which the lamps of one side dim.

use taceva_dataset::{Leds, PictureSide};

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
    effect: Effect::Leds(apply),
};

/// Dims the colours whose LEDs stand at the lost side; all colours from the left if no side is known.
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
            let dimmed = pixel
                .iter_mut()
                .zip(is_lost)
                .filter(|(_, is_lost)| *is_lost);
            dimmed.for_each(|(value, _)| *value *= kept);
        }
    }
}

/// First of left, right, top and bottom at which LEDs stand; `None` if no side is known.
fn lost_side(leds: Leds) -> Option<PictureSide> {
    leds.sides().into_iter().flatten().min()
}

/// Remark on the colours that dim; `None` if no side is known.
pub(crate) fn note_on(leds: Leds) -> Option<String> {
    let lost = lost_side(leds)?;
    let colours = ["red", "green", "blue"].into_iter().zip(leds.sides());
    let dimmed = colours.filter(|(_, side)| *side == Some(lost));
    let dimmed: Vec<&str> = dimmed.map(|(colour, _)| colour).collect();
    let side = format!("{lost:?}").to_lowercase();
    Some(format!(
        "only {} dims, from the {side} edge, because `leds` in [sensor] of the recording places its LEDs there",
        dimmed.join(" and ")
    ))
}
