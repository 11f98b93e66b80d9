//! Fault of pictures: markers that fall off or fade.

use taceva_core::{single, whole_size};

use crate::canvas::{Canvas, Realisation};
use crate::fault::{Effect, Fault, Markers, Scope};

pub(super) static FAULT: Fault = Fault {
    id: "marker_loss",
    title: "markers are painted over with the gel around them",
    parameter: "share of the markers",
    scope: Scope::Drawn,
    table: [0.02, 0.05, 0.1, 0.25, 0.5],
    most: 1.0,
    note: Some(
        "markers are found in the untouched picture, and each is painted over to 0.35 of the marker spacing",
    ),
    effect: Effect::Markers(apply),
};

/// Radius of the painted spot of a marker, in marker spacings.
const PAINTED: f64 = 0.35;
/// Outer radius of the ring of gel around a marker, in marker spacings.
const RING: f64 = 0.55;

fn apply(canvas: &mut Canvas, drawn: &Realisation, markers: &Markers) {
    let count = markers.places_px.len();
    let lost = f64::from(drawn.parameter) * count as f64;
    let order = drawn.draws.order(count);
    for (number, marker) in order.into_iter().enumerate() {
        let strength = (lost - number as f64).min(1.0);
        if strength <= 0.0 {
            break;
        }
        let place = markers.places_px[marker];
        if place.iter().all(|at| at.is_finite()) {
            paint(canvas, place, markers.spacing_px, strength);
        }
    }
}

/// Replaces the pixels of a marker, to the share `strength`, by the mean of the ring of gel around the marker.
fn paint(canvas: &mut Canvas, place: [f64; 2], spacing: f64, strength: f64) {
    let (painted, ring) = (PAINTED * spacing, RING * spacing);
    let mut inside = Vec::new();
    let mut sums = vec![0.0_f64; canvas.colours()];
    let mut around = 0_u32;
    let from = |middle: f64| whole_size((middle - ring).max(0.0));
    let to = |middle: f64, end: usize| (whole_size((middle + ring).max(0.0)) + 2).min(end);
    let [x, y] = place;
    for row in from(y)..to(y, canvas.height()) {
        for column in from(x)..to(x, canvas.width()) {
            let (across, down) = (column as f64 - x, row as f64 - y);
            let distance = (across * across + down * down).sqrt();
            if distance <= painted {
                inside.push((column, row));
            } else if distance <= ring {
                around += 1;
                let pixel = canvas.pixel(column, row);
                for (sum, value) in sums.iter_mut().zip(pixel) {
                    *sum += f64::from(*value);
                }
            }
        }
    }
    if around == 0 {
        return;
    }
    let mix = single(strength);
    for (column, row) in inside {
        for (value, sum) in canvas.pixel(column, row).iter_mut().zip(&sums) {
            let gel = single(sum / f64::from(around));
            *value += mix * (gel - *value);
        }
    }
}
