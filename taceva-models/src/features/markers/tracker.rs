//! Tracking of markers from the untouched gel to other frames.

mod growth;

use taceva_core::{Frame, FrameInfo};

use self::growth::Growth;
use super::lattice::{Lattice, closest};
use super::plane::Plane;
use super::spots::{Marker, Polarity, distance, spots};
use crate::features::FeatureError;

/// Number of neighbours that predict the position of a marker.
const NEIGHBOURS: usize = 8;
/// Largest number of markers at which a match to spots may start.
const SEEDS: usize = 4;
/// Largest displacement of a marker at which a match starts, in marker spacings.
const SEED_REACH: f64 = 1.6;
/// Cost of a marker that moved by one spacing; an unseen marker costs 1. A regular grid moved by one spacing differs only at its rim. If the rim is
/// also hidden, the match with less movement is chosen.
const MOVEMENT: f64 = 0.02;
/// Share of unseen markers up to which a match is accepted without a trial of other starting markers.
const ENOUGH: f64 = 0.03;

/// A tracked marker.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tracked {
    /// Displacement of the marker from its position on the untouched gel, right and down, in pixels. Interpolated from neighbours if the marker is
    /// unseen.
    pub displacement_px: [f64; 2],
    /// True if the marker was found in the frame.
    pub is_seen: bool,
}

/// Tracks the markers of an untouched gel in other frames.
///
/// Markers may be dark or bright, on a square or hexagonal grid with gaps. Matching of markers to detected spots starts at a marker that has hardly
/// moved, and grows from neighbour to neighbour. Matched neighbours predict the search position, so a marker may move farther than the spacing.
/// Several starting markers are tried, and the match of least cost is used. The cost counts unseen markers, and grows with displacements.
///
/// ```
/// use taceva_core::{Frame, FrameInfo, PixelFormat};
/// use taceva_models::{MarkerTracker, Polarity};
///
/// // Four rows of six white dots of 5×5 pixels, 16 pixels apart, on a black gel.
/// let info = FrameInfo { width: 128, height: 96, format: PixelFormat::Gray8 };
/// let dots = |right: usize| {
///     let lit = |at: usize, dots: usize| (6..11).contains(&(at % 16)) && (1..=dots).contains(&(at / 16));
///     let pixel = |at: usize| if lit((at % 128).saturating_sub(right), 6) && lit(at / 128, 4) { 255 } else { 0 };
///     Frame::new(info, (0..128 * 96).map(pixel).collect())
/// };
/// let tracker = MarkerTracker::new(&dots(0)?)?;
/// assert_eq!((tracker.polarity(), tracker.markers().len()), (Polarity::Bright, 24));
/// let tracked = tracker.track(&dots(3)?)?;
/// assert!(tracked.iter().all(|marker| (marker.displacement_px[0] - 3.0).abs() < 0.05));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct MarkerTracker {
    info: FrameInfo,
    lattice: Lattice,
    places: Vec<[f64; 2]>,
    /// Indices of the nearest neighbours of each marker.
    neighbours: Vec<Vec<usize>>,
}

impl MarkerTracker {
    /// Finds the markers of the untouched gel in `reference`.
    ///
    /// # Errors
    /// [`FeatureError::NoMarkers`] if there are no significant spots, or if the spots form no grid.
    pub fn new(reference: &Frame) -> Result<MarkerTracker, FeatureError> {
        let lattice = Lattice::find(&Plane::of(reference))
            .map_err(|found| FeatureError::NoMarkers { found })?;
        let places: Vec<[f64; 2]> = lattice.markers.iter().map(|own| own.place_px).collect();
        let around = |(own, place): (usize, &[f64; 2])| {
            let mut close = closest(*place, &places, NEIGHBOURS + 1);
            close.retain(|other| *other != own);
            close
        };
        Ok(MarkerTracker {
            info: reference.info(),
            neighbours: places.iter().enumerate().map(around).collect(),
            lattice,
            places,
        })
    }

    /// Polarity of the markers: dark or bright.
    pub fn polarity(&self) -> Polarity {
        self.lattice.scale.polarity
    }

    /// Typical spacing of markers, in pixels.
    pub fn spacing_px(&self) -> f64 {
        self.lattice.spacing_px
    }

    /// Markers of the untouched gel, highest contrast first.
    pub fn markers(&self) -> &[Marker] {
        &self.lattice.markers
    }

    /// Tracks each of [`markers`](MarkerTracker::markers) in `frame`.
    ///
    /// # Errors
    /// [`FeatureError::Kind`] if the frame differs from the reference in size or format.
    pub fn track(&self, frame: &Frame) -> Result<Vec<Tracked>, FeatureError> {
        if frame.info() != self.info {
            return Err(FeatureError::Kind {
                expected: self.info,
                found: frame.info(),
            });
        }
        Ok(self.follow(frame))
    }

    /// Tracks markers in a frame whose size and format were checked.
    pub(super) fn follow(&self, frame: &Frame) -> Vec<Tracked> {
        let found = spots(&Plane::of(frame), self.lattice.scale, self.lattice.least);
        let found: Vec<[f64; 2]> = found.iter().map(|spot| spot.place_px).collect();
        let mut best = Growth::new(self, &found);
        let mut least = f64::INFINITY;
        for (seed, spot) in self.beginnings(&found) {
            let mut growth = Growth::new(self, &found);
            growth.grow_from(seed, spot);
            let cost = growth.cost(MOVEMENT);
            if cost < least {
                least = cost;
                best = growth;
            }
            if best.unseen() as f64 <= ENOUGH * self.places.len() as f64 {
                break;
            }
        }
        best.tracked()
    }

    /// Pairs of a marker and a nearby spot at which a match may start, the closest pair first. Only the markers closest to any spot, relative to
    /// their own spacing, have pairs.
    fn beginnings(&self, found: &[[f64; 2]]) -> Vec<(usize, usize)> {
        let mut seeds: Vec<(f64, usize)> = Vec::new();
        for (own, place) in self.places.iter().enumerate() {
            let off = found.iter().map(|spot| distance(*place, *spot));
            let least = off.fold(f64::INFINITY, f64::min);
            seeds.push((least / self.lattice.spacings_px[own], own));
        }
        seeds.sort_by(|left, right| left.0.total_cmp(&right.0).then(left.1.cmp(&right.1)));
        let mut pairs = Vec::new();
        for (_, own) in seeds.into_iter().take(SEEDS) {
            let reach = SEED_REACH * self.lattice.spacings_px[own];
            for spot in closest(self.places[own], found, found.len()) {
                let off = distance(self.places[own], found[spot]);
                if off <= reach {
                    pairs.push((off, own, spot));
                }
            }
        }
        pairs.sort_by(|left, right| left.0.total_cmp(&right.0));
        pairs
            .into_iter()
            .map(|(_, own, spot)| (own, spot))
            .collect()
    }
}

#[cfg(test)]
mod tests;
