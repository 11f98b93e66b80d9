//! Detection of the grid of markers on an untouched gel.

use super::plane::Plane;
use super::spots::{Marker, Polarity, Scale, distance, spots};

/// Minimum contrast of a marker, in standard deviations of the contrast that noise causes. Noise exceeds it in less than one of a million pixels.
const SIGNIFICANT: f32 = 6.0;
/// Minimum contrast of a marker, relative to the upper quartile of the contrast of all spots. The low value allows for uneven light.
const ALIKE: f32 = 0.15;
/// Smallest number of markers expected along the shorter side of a frame. It gives the largest spacing that is tried.
const ACROSS_MIN: f64 = 4.0;
/// Smallest spacing of markers that is tried, in pixels.
const SPACING_MIN_PX: f64 = 5.0;
/// Ratio of each tried spacing of markers to the spacing tried before.
const FINER: f64 = 0.8;
/// Number of neighbours that determine a marker's local spacing, in addition to the marker.
const NEIGHBOURS: usize = 6;
/// Minimum number of spots for the test of evenness. Fewer spots pass without it, because they fit any arrangement.
const GRID_MIN: usize = 9;
/// Largest allowed unevenness of a grid. For each spot, the distance to its third nearest spot is divided by the distance to its nearest. Unevenness
/// is the median of this ratio minus 1. It is 0 in square and hexagonal grids, and about 0.5 for random spots.
const UNEVEN: f64 = 0.3;

/// Grid of the markers of an untouched gel, with the settings of its detection.
#[derive(Clone, Debug)]
pub(super) struct Lattice {
    /// Polarity and spacing with which the markers were detected. Later frames use the same.
    pub(super) scale: Scale,
    /// Median of the local spacings of markers, in pixels.
    pub(super) spacing_px: f64,
    /// Contrast that a spot must exceed to count as a marker.
    pub(super) least: f32,
    /// Markers in descending order of contrast.
    pub(super) markers: Vec<Marker>,
    /// Local spacing at each marker, in pixels, in the order of `markers`.
    pub(super) spacings_px: Vec<f64>,
    unevenness: f64,
}

impl Lattice {
    /// Finds the grid of markers in `picture`. Dark and bright markers of several sizes are tried, and the grid with the highest score wins.
    ///
    /// # Errors
    /// Number of spots found, if the spots form no grid.
    pub(super) fn find(picture: &Plane) -> Result<Lattice, usize> {
        let noise = picture.noise();
        let shorter = picture.width.min(picture.height) as f64;
        let mut best: Option<Lattice> = None;
        for polarity in [Polarity::Dark, Polarity::Bright] {
            let mut spacing_px = shorter / ACROSS_MIN;
            while spacing_px >= SPACING_MIN_PX {
                let scale = Scale {
                    polarity,
                    spacing_px,
                };
                let found = Lattice::at(picture, scale, noise);
                // Repeats the detection at the spacing found.
                let found = found.and_then(|first| {
                    let scale = Scale {
                        spacing_px: first.spacing_px,
                        polarity,
                    };
                    Lattice::at(picture, scale, noise)
                });
                if let Some(found) = found
                    && best
                        .as_ref()
                        .is_none_or(|best| found.score() > best.score())
                {
                    best = Some(found);
                }
                spacing_px *= FINER;
            }
        }
        match best {
            None => Err(0),
            Some(best) if best.unevenness > UNEVEN => Err(best.markers.len()),
            Some(best) => Ok(best),
        }
    }

    /// Detects spots of one polarity and size, and computes their spacings. `None` if no spot is found.
    fn at(picture: &Plane, scale: Scale, noise: f32) -> Option<Lattice> {
        let significant = SIGNIFICANT * scale.noise_gain() * noise;
        let mut markers = spots(picture, scale, significant);
        // Sorted by contrast: this is the upper quartile.
        let least = significant.max(ALIKE * markers.get(markers.len() / 4)?.contrast);
        markers.retain(|marker| marker.contrast > least);
        let spacings_px = spacings(&markers, scale.spacing_px);
        let unevenness = if markers.len() < GRID_MIN {
            0.0
        } else {
            unevenness(&markers)
        };
        Some(Lattice {
            scale,
            spacing_px: median(spacings_px.clone()),
            least,
            markers,
            spacings_px,
            unevenness,
        })
    }

    /// Quality of the grid. Many spots, high contrast and even distances give a high value.
    fn score(&self) -> f64 {
        let contrast = f64::from(self.markers[self.markers.len() / 2].contrast);
        (self.markers.len() as f64).sqrt() * contrast * (-4.0 * self.unevenness).exp()
    }
}

/// Local spacing at each marker, in pixels: the median distance to the nearest marker, taken over the marker and its neighbours. `otherwise` for a
/// single marker.
fn spacings(markers: &[Marker], otherwise: f64) -> Vec<f64> {
    let nearest = nearest_distances(markers, otherwise);
    let places: Vec<[f64; 2]> = markers.iter().map(|marker| marker.place_px).collect();
    let around = |own: &[f64; 2]| {
        let close = closest(*own, &places, NEIGHBOURS + 1).into_iter();
        median(close.map(|other| nearest[other]).collect())
    };
    places.iter().map(around).collect()
}

fn nearest_distances(markers: &[Marker], otherwise: f64) -> Vec<f64> {
    let of = |(position, own): (usize, &Marker)| {
        let others = markers
            .iter()
            .enumerate()
            .filter(|(other, _)| *other != position);
        let distances = others.map(|(_, other)| distance(own.place_px, other.place_px));
        let least = distances.fold(f64::INFINITY, f64::min);
        if least.is_finite() { least } else { otherwise }
    };
    markers.iter().enumerate().map(of).collect()
}

/// Distance of a marker to its third nearest marker, divided by the distance to its nearest, minus 1. The result is the median over at least four
/// markers.
fn unevenness(markers: &[Marker]) -> f64 {
    let places: Vec<[f64; 2]> = markers.iter().map(|marker| marker.place_px).collect();
    let of = |own: &[f64; 2]| {
        // The closest place is the marker itself.
        let close = closest(*own, &places, 4);
        let far = |rank: usize| distance(*own, places[close[rank]]);
        far(3) / far(1) - 1.0
    };
    median(places.iter().map(of).collect())
}

/// Indices of the `count` positions in `places` that are closest to `place`, the closest first. Equal distances are sorted by index.
pub(super) fn closest(place: [f64; 2], places: &[[f64; 2]], count: usize) -> Vec<usize> {
    let mut order: Vec<(f64, usize)> = places
        .iter()
        .enumerate()
        .map(|(position, other)| (distance(place, *other), position))
        .collect();
    order.sort_by(|left, right| left.0.total_cmp(&right.0).then(left.1.cmp(&right.1)));
    order.truncate(count);
    order.into_iter().map(|(_, position)| position).collect()
}

/// Median of `values`; for an even count, the upper of the two middle values.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
