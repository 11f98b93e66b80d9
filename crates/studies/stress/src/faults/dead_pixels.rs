//! Fault of pictures: pixels of the camera that no longer respond to light.

use crate::canvas::{Canvas, Realisation};
use crate::fault::{Effect, Fault, Scope};

pub(super) static FAULT: Fault = Fault {
    id: "dead_pixels",
    title: "pixels stay at zero or at full scale",
    parameter: "share of pixels",
    scope: Scope::Drawn,
    table: [1e-4, 5e-4, 2e-3, 8e-3, 3e-2],
    most: 1.0,
    note: None,
    effect: Effect::Numbers(apply),
};

fn apply(canvas: &mut Canvas, drawn: &Realisation) {
    let full = canvas.full();
    for (counter, pixel) in (0_u64..).zip(canvas.pixels()) {
        if drawn.unit(2 * counter) < drawn.parameter {
            let is_bright = drawn.unit(2 * counter + 1) < 0.5;
            pixel.fill(if is_bright { full } else { 0.0 });
        }
    }
}
