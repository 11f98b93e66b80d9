//! Fault of pictures: scratches in the coating.

use crate::canvas::{Canvas, Defect, Realisation, index};
use crate::fault::{Effect, Fault, LIES_STILL, Scope};

pub(super) static FAULT: Fault = Fault {
    id: "scratches",
    title: "bright lines of 5 to 25 % of the width",
    parameter: "number of lines",
    scope: Scope::Drawn,
    table: [2.0, 5.0, 12.0, 30.0, 70.0],
    most: 2000.0,
    note: Some(LIES_STILL),
    effect: Effect::Numbers(apply),
};

/// Brightness that a scratch adds, as a fraction of the greatest pixel value.
const LIGHT: f32 = 40.0 / 255.0;
/// Number of attempts to draw the random direction of a scratch. All fail for fewer than one scratch in 10³⁸.
const ATTEMPTS: u64 = 60;

fn apply(canvas: &mut Canvas, drawn: &Realisation) {
    for line in drawn.defects() {
        draw(canvas, &line);
    }
}

fn draw(canvas: &mut Canvas, line: &Defect) {
    let (width, height) = (canvas.width() as f32, canvas.height() as f32);
    let start = [line.unit(0) * width, line.unit(1) * height];
    let length = (0.05 + 0.2 * line.unit(2)) * width;
    let [x, y] = direction(line);
    let added = LIGHT * canvas.full() * line.strength;
    let mut before = None;
    for step in 0..=index(length) + 1 {
        let along = (step as f32).min(length);
        let place = [start[0] + along * x, start[1] + along * y];
        let is_inside = (0.0..width).contains(&place[0]) && (0.0..height).contains(&place[1]);
        let at = place.map(index);
        if is_inside && before != Some(at) {
            let pixel = canvas.pixel(at[0], at[1]);
            pixel.iter_mut().for_each(|value| *value += added);
            before = Some(at);
        }
    }
}

/// Random direction as a unit vector. A random point of the unit disc is divided by its length.
fn direction(line: &Defect) -> [f32; 2] {
    let points = (0..ATTEMPTS).map(|attempt| {
        let coordinate = |counter: u64| 2.0 * line.unit(3 + 2 * attempt + counter) - 1.0;
        [coordinate(0), coordinate(1)]
    });
    let lengths = points.map(|[x, y]| ([x, y], (x * x + y * y).sqrt()));
    let mut inside = lengths.filter(|(_, length)| (0.1..=1.0).contains(length));
    let found = inside.next();
    found.map_or([1.0, 0.0], |([x, y], length)| [x / length, y / length])
}
