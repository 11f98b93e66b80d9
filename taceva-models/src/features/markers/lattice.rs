//! Detects the marker grid of an untouched gel.

use super::plane::Plane;
use super::spots::{Marker, Polarity, Scale, distance, spots};

/// Minimum contrast of a marker, in standard deviations of noise. By chance, fewer than one in a million pixels exceed this contrast.
const SIGNIFICANT: f32 = 6.0;
/// Minimum contrast of a marker, relative to the upper quartile of all spots. The low value allows for uneven lamps.
const ALIKE: f32 = 0.15;
/// Minimum number of marker columns across the shorter side of a frame.
const ACROSS_MIN: f64 = 4.0;
/// Smallest spacing of markers, in pixels.
const SPACING_MIN_PX: f64 = 5.0;
/// Ratio of each tried spacing to the previous spacing.
const FINER: f64 = 0.8;
/// Number of neighbours that determine the local spacing of a marker.
const NEIGHBOURS: usize = 6;
/// Minimum number of spots in a grid. Fewer spots would fit into any arrangement.
const GRID_MIN: usize = 9;
/// Largest allowed unevenness of a grid. Unevenness is the median relative excess of the distance to the third nearest spot over the distance to the
/// nearest. The unevenness is 0 in square and hexagonal grids, and about 0.5 for random spots.
const UNEVEN: f64 = 0.3;

/// Markers of an untouched gel.
#[derive(Clone, Debug)]
pub(super) struct Lattice {
    /// Scale of detection, which is also used for other frames.
    pub(super) scale: Scale,
    /// Typical spacing of markers, in pixels.
    pub(super) spacing_px: f64,
    /// Minimum contrast of a spot.
    pub(super) least: f32,
    /// Markers, highest contrast first.
    pub(super) markers: Vec<Marker>,
    /// Local spacing around each marker, in pixels.
    pub(super) spacings_px: Vec<f64>,
    unevenness: f64,
}

impl Lattice {
    /// Finds the marker grid of `picture`. Tries all polarities and scales, and returns the grid with the best score.
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

    /// Detects spots at one scale and computes their spacings; `None` without spots.
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

    /// Quality of the grid: high for many spots with high contrast at even distances.
    fn score(&self) -> f64 {
        let contrast = f64::from(self.markers[self.markers.len() / 2].contrast);
        (self.markers.len() as f64).sqrt() * contrast * (-4.0 * self.unevenness).exp()
    }
}

/// Local spacing around each marker, in pixels; `otherwise` for a single marker.
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

/// Median relative excess of the distance to the third nearest marker over the distance to the nearest. Needs at least four markers.
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

/// Indices of the `count` places closest to `place`, sorted by distance. Equal distances are sorted by index.
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
