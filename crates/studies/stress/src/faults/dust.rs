//! Fault of pictures: dust and bubbles between camera and gel.

use taceva_core::single;
use taceva_metrics::elementary::exponential;

use crate::canvas::{Canvas, Defect, Realisation, index};
use crate::fault::{Effect, Fault, LIES_STILL, Scope};

pub(super) static FAULT: Fault = Fault {
    id: "dust",
    title: "dark spots of 0.5 to 1.5 % of the width",
    parameter: "number of spots",
    scope: Scope::Drawn,
    table: [1.0, 3.0, 6.0, 12.0, 25.0],
    most: 2000.0,
    note: Some(LIES_STILL),
    effect: Effect::Numbers(apply),
};

/// Fraction of the light that the middle of a spot of dust blocks.
const LOST: f32 = 0.6;
/// Radius to which a spot of dust is drawn, in standard deviations of its Gaussian profile.
const REACH: f32 = 4.0;

fn apply(canvas: &mut Canvas, drawn: &Realisation) {
    for spot in drawn.defects() {
        darken(canvas, &spot);
    }
}

fn darken(canvas: &mut Canvas, spot: &Defect) {
    let (width, height) = (canvas.width(), canvas.height());
    let (x, y) = (spot.unit(0) * width as f32, spot.unit(1) * height as f32);
    let deviation = (0.005 + 0.01 * spot.unit(2)) * width as f32;
    let lost = LOST * spot.strength;
    let reach = REACH * deviation;
    let from = |middle: f32| index(middle - reach);
    let to = |middle: f32, end: usize| (index(middle + reach) + 1).min(end);
    for line in from(y)..to(y, height) {
        let down = line as f32 + 0.5 - y;
        for column in from(x)..to(x, width) {
            let across = column as f32 + 0.5 - x;
            let square = (across * across + down * down) / (deviation * deviation);
            let kept = 1.0 - lost * single(exponential(f64::from(-0.5 * square)));
            let pixel = canvas.pixel(column, line);
            pixel.iter_mut().for_each(|value| *value *= kept);
        }
    }
}
