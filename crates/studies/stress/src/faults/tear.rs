//! Fault of pictures: a tear of the coating.

use crate::canvas::{Canvas, Realisation};
use crate::fault::{Effect, Fault, LIES_STILL, Scope};

pub(super) static FAULT: Fault = Fault {
    id: "tear",
    title: "a disc reflects a fifth of the light",
    parameter: "radius, share of the width",
    scope: Scope::Drawn,
    table: [0.02, 0.04, 0.07, 0.11, 0.16],
    most: 1.0,
    note: Some(LIES_STILL),
    effect: Effect::Numbers(apply),
};

/// Fraction of the light that is lost at the tear.
const LOST: f32 = 0.8;

fn apply(canvas: &mut Canvas, drawn: &Realisation) {
    let (width, height) = (canvas.width() as f32, canvas.height() as f32);
    let colours = canvas.colours();
    let centre = [drawn.unit(0), drawn.unit(1)].map(|unit| 0.2 + 0.6 * unit);
    let (x, y) = (centre[0] * width, centre[1] * height);
    let radius = drawn.parameter * width;
    for (line, row) in canvas.rows().enumerate() {
        let down = line as f32 + 0.5 - y;
        for (column, pixel) in row.chunks_exact_mut(colours).enumerate() {
            let across = column as f32 + 0.5 - x;
            let distance = (across * across + down * down).sqrt();
            // Pixels at the edge are covered in part, so that any radius changes the picture.
            let covered = (radius - distance + 0.5).clamp(0.0, 1.0).min(radius);
            let kept = 1.0 - LOST * covered;
            pixel.iter_mut().for_each(|value| *value *= kept);
        }
    }
}
