//! Which spots of an untouched gel are its markers.

use super::plane::Plane;
use super::spots::{Marker, Polarity, Scale, distance, spots};

/// Standard deviations of noise that a marker stands out by at least: none of a million pixels does by chance.
const SIGNIFICANT: f32 = 6.0;
/// The share of what the upper quarter of spots stand out by that a marker stands out by at least: lamps shine unevenly.
const ALIKE: f32 = 0.15;
/// Columns of a frame across its shorter side at least.
const ACROSS_MIN: f64 = 4.0;
/// The nearest that markers may stand, in pixels.
const SPACING_MIN_PX: f64 = 5.0;
/// How much finer each scale that is tried is than the one before.
const FINER: f64 = 0.8;
/// Neighbours by which the distance of a marker from the next is judged.
const NEIGHBOURS: usize = 6;
/// Spots that make a grid at least: of fewer any arrangement is taken.
const GRID_MIN: usize = 9;
/// How much further away than the nearest the third nearest spot is, as a share and for half of the spots, where they stand in no grid: in a square or
/// hexagonal one they are as far, at random half as far again.
const UNEVEN: f64 = 0.3;

/// The markers of an untouched gel.
#[derive(Clone, Debug)]
pub(super) struct Lattice {
    /// The scale at which they are found, here and in other frames alike.
    pub(super) scale: Scale,
    /// The typical distance of a marker from the next.
    pub(super) spacing_px: f64,
    /// How much a spot stands out by at least.
    pub(super) least: f32,
    /// The markers, the most outstanding first.
    pub(super) markers: Vec<Marker>,
    /// Distances of each marker and its neighbours from the next.
    pub(super) spacings_px: Vec<f64>,
    unevenness: f64,
}

impl Lattice {
    /// The grid of `picture`: of all polarities and scales the one with most, clearest and most even spots.
    ///
    /// # Errors
    /// How many spots there are that stand in no grid.
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
                // Once more at the spacing that was found.
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

    /// The spots at one scale, and how far apart they stand; `None` if there is none.
    fn at(picture: &Plane, scale: Scale, noise: f32) -> Option<Lattice> {
        let significant = SIGNIFICANT * scale.noise_gain() * noise;
        let mut markers = spots(picture, scale, significant);
        // The most outstanding come first: this is the upper quartile.
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

    /// What counts in favour: many spots, each clear, at even distances.
    fn score(&self) -> f64 {
        let contrast = f64::from(self.markers[self.markers.len() / 2].contrast);
        (self.markers.len() as f64).sqrt() * contrast * (-4.0 * self.unevenness).exp()
    }
}

/// The typical distance of a marker from the next around each marker; `otherwise` for one that is alone.
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

/// How much further away the third nearest is than the nearest, for half of the markers, of which there are four at least.
fn unevenness(markers: &[Marker]) -> f64 {
    let places: Vec<[f64; 2]> = markers.iter().map(|marker| marker.place_px).collect();
    let of = |own: &[f64; 2]| {
        // The first is the place itself.
        let close = closest(*own, &places, 4);
        let far = |rank: usize| distance(*own, places[close[rank]]);
        far(3) / far(1) - 1.0
    };
    median(places.iter().map(of).collect())
}

/// The `count` places closest to `place`, the closest first, of equals the earlier.
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

/// The upper of the two in the middle.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
