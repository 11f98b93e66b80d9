//! Subpixel detection of spots darker or brighter than their surroundings.

use super::plane::Plane;
use taceva_core::whole_size;

/// Contrast of markers with the gel: darker or brighter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Polarity {
    /// Black dots on a brighter gel.
    Dark,
    /// White or glowing tips on a darker gel.
    Bright,
}

/// A detected spot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Marker {
    /// Column and row of the spot, in pixels from the centre of the first pixel.
    pub place_px: [f64; 2],
    /// Contrast with the surroundings; full scale is 1.
    pub contrast: f32,
}

/// Polarity and spacing of spots to detect.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scale {
    pub(super) polarity: Polarity,
    pub(super) spacing_px: f64,
}

/// Smallest distance between two spots, in marker spacings.
const APART: f64 = 0.5;

impl Scale {
    /// Half width, in pixels, of the averaging square, whose side is a fifth of the marker spacing. Spot detection averages twice over this square.
    fn near(self) -> usize {
        whole(0.1 * self.spacing_px)
    }

    /// Half width, in pixels, of the square whose mean is the local background. The square is one marker spacing wide, so its edges cut no
    /// neighbouring spots. A cut spot would shift the position.
    fn around(self) -> usize {
        whole(0.5 * self.spacing_px)
    }

    /// Standard deviation of the response of [`spots`] to pixel noise of standard deviation 1. Includes both averages near the spot, but not the
    /// noise of the background mean.
    pub(super) fn noise_gain(self) -> f32 {
        let side = (2 * self.near() + 1) as f32;
        (2.0 * side * side + 1.0) / (3.0 * side * side * side)
    }
}

fn whole(pixels: f64) -> usize {
    whole_size(pixels.round().max(1.0))
}

/// Detects spots of `picture` with a contrast above `least`, highest contrast first.
///
/// The response of a pixel is a tent-weighted local mean minus the mean of its surroundings, negated for dark spots. A spot is the greatest response
/// within half a marker spacing. Its position is the vertex of a paraboloid fitted by least squares to nine responses around the maximum. Spots at
/// the edge of the frame are skipped.
pub(super) fn spots(picture: &Plane, scale: Scale, least: f32) -> Vec<Marker> {
    let response = response(picture, scale);
    let (width, height) = (picture.width, picture.height);
    let step = scale.near().div_ceil(2);
    let margin = 2 * scale.near() + step;
    let mut tops = Vec::new();
    for row in margin..height.saturating_sub(margin) {
        for column in margin..width.saturating_sub(margin) {
            let place = row * width + column;
            if response[place] > least && is_top(&response, width, place) {
                tops.push(marker(&response, width, place, step));
            }
        }
    }
    // The stable sort keeps the upper or left one of equal spots first.
    tops.sort_by(|left, right| right.contrast.total_cmp(&left.contrast));
    let mut kept: Vec<Marker> = Vec::new();
    let apart = APART * scale.spacing_px;
    for top in tops {
        let is_free = |other: &Marker| distance(other.place_px, top.place_px) >= apart;
        if kept.iter().all(is_free) {
            kept.push(top);
        }
    }
    kept
}

fn response(picture: &Plane, scale: Scale) -> Vec<f32> {
    let near = picture.local_mean(scale.near()).local_mean(scale.near());
    let around = picture.local_mean(scale.around());
    let sign = match scale.polarity {
        Polarity::Dark => -1.0,
        Polarity::Bright => 1.0,
    };
    let pairs = near.values.iter().zip(&around.values);
    pairs.map(|(near, around)| sign * (near - around)).collect()
}

/// True if the response at index `place` is a maximum among its eight neighbours. Of equal neighbours, only the first in row order is a maximum.
fn is_top(response: &[f32], width: usize, place: usize) -> bool {
    let own = response[place];
    let before = [
        place - width - 1,
        place - width,
        place - width + 1,
        place - 1,
    ];
    let after = [
        place + 1,
        place + width - 1,
        place + width,
        place + width + 1,
    ];
    before.iter().all(|&other| response[other] < own)
        && after.iter().all(|&other| response[other] <= own)
}

/// Marker at the vertex of the paraboloid fitted to nine responses: at index `place` and `step` pixels to each side.
fn marker(response: &[f32], width: usize, place: usize, step: usize) -> Marker {
    let at = |column: usize, row: usize| {
        f64::from(response[place + row * step * width + column * step - step * width - step])
    };
    let column = |column| at(column, 0) + at(column, 1) + at(column, 2);
    let row = |row| at(0, row) + at(1, row) + at(2, row);
    let slope = [(column(2) - column(0)) / 6.0, (row(2) - row(0)) / 6.0];
    let bend = [
        (column(0) - 2.0 * column(1) + column(2)) / 3.0,
        (row(0) - 2.0 * row(1) + row(2)) / 3.0,
    ];
    let twist = (at(2, 2) - at(0, 2) - at(2, 0) + at(0, 0)) / 4.0;
    let determinant = bend[0] * bend[1] - twist * twist;
    // A maximum has negative curvature in all directions; otherwise takes the pixel itself.
    let off = if determinant > 0.0 && bend[0] < 0.0 {
        [
            (twist * slope[1] - bend[1] * slope[0]) / determinant,
            (twist * slope[0] - bend[0] * slope[1]) / determinant,
        ]
    } else {
        [0.0; 2]
    };
    let pixels = |off: f64| (off * step as f64).clamp(-1.0, 1.0);
    Marker {
        place_px: [
            (place % width) as f64 + pixels(off[0]),
            (place / width) as f64 + pixels(off[1]),
        ],
        contrast: response[place],
    }
}

pub(super) fn distance(left: [f64; 2], right: [f64; 2]) -> f64 {
    (left[0] - right[0]).hypot(left[1] - right[1])
}
