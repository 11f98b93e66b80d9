//! Fault of pictures: a bad cable or connector, which displaces lines or fills them with one level.

use taceva_core::random::scaled;

use crate::canvas::{Canvas, Realisation};
use crate::fault::{Effect, Fault, Scope};

pub(super) static FAULT: Fault = Fault {
    id: "cable_noise",
    title: "lines are displaced by up to 8 pixels, or lost",
    parameter: "share of lines",
    scope: Scope::Each,
    table: [0.005, 0.01, 0.03, 0.08, 0.2],
    most: 1.0,
    note: None,
    effect: Effect::Numbers(apply),
};

/// Fraction of the bad lines that are displaced. In another bad line, all pixels have the same value.
const DISPLACED: f32 = 0.7;
/// Greatest displacement of a line, in pixels.
const MOST: u64 = 8;
/// Number of random numbers that each line of a picture uses.
const DRAWS: u64 = 4;

fn apply(canvas: &mut Canvas, drawn: &Realisation) {
    let (colours, full) = (canvas.colours(), canvas.full());
    let length = canvas.width() * colours;
    for (line, row) in (0_u64..).zip(canvas.rows()) {
        let first = DRAWS * line;
        if drawn.unit(first) >= drawn.parameter {
            continue;
        }
        if drawn.unit(first + 1) >= DISPLACED {
            row.fill(drawn.unit(first + 2) * full);
            continue;
        }
        let pixels = 1 + scaled(drawn.draws.bits(first + 2), MOST);
        let by = usize::try_from(pixels).expect("8 at most") * colours % length;
        match drawn.unit(first + 3) < 0.5 {
            true => row.rotate_left(by),
            false => row.rotate_right(by),
        }
    }
}
