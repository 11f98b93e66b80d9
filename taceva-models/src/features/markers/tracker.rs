//! From the markers of an untouched gel to where each of them is in a frame.

mod growth;

use taceva_core::{Frame, FrameInfo};

use self::growth::Growth;
use super::lattice::{Lattice, closest};
use super::plane::Plane;
use super::spots::{Marker, Polarity, distance, spots};
use crate::features::FeatureError;

/// Markers around one that say where it should be.
const NEIGHBOURS: usize = 8;
/// Markers from which a match is begun.
const SEEDS: usize = 4;
/// How far a seed may have moved, in spacings.
const SEED_REACH: f64 = 1.6;
/// What a displacement of one spacing counts against a marker that is not seen: a regular grid looks the same when it is moved by a whole
/// spacing but for its rim, and where even that is hidden, less movement is likelier.
const MOVEMENT: f64 = 0.02;
/// The share of markers that may be unseen before another beginning is tried.
const ENOUGH: f64 = 0.03;

/// A marker in a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tracked {
    /// Pixels to the right and down from where it was when nobody touched the gel; of a marker that is not seen, what its neighbours say.
    pub displacement_px: [f64; 2],
    /// Whether it is seen.
    pub is_seen: bool,
}

/// The markers of an untouched gel, and how to find them again.
///
/// They may be dark or bright, on a square or a hexagonal grid of which some are missing. In a frame, the match begins at a marker that has
/// hardly moved and grows from neighbour to neighbour, each looked for where those before it say, so that a marker may move by more than the
/// distance to the next. Several beginnings are tried, and the match that finds most markers is taken.
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
    /// For each marker those closest to it.
    neighbours: Vec<Vec<usize>>,
}

impl MarkerTracker {
    /// The tracker of a gel as `reference` shows it untouched.
    ///
    /// # Errors
    /// [`FeatureError::NoMarkers`] if nothing stands out, or what does stands in no grid.
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

    /// Whether markers are dark or bright.
    pub fn polarity(&self) -> Polarity {
        self.lattice.scale.polarity
    }

    /// The typical distance of a marker from the next, in pixels.
    pub fn spacing_px(&self) -> f64 {
        self.lattice.spacing_px
    }

    /// The markers of the untouched gel, the most outstanding first.
    pub fn markers(&self) -> &[Marker] {
        &self.lattice.markers
    }

    /// Each of [`markers`](MarkerTracker::markers) in `frame`.
    ///
    /// # Errors
    /// [`FeatureError::Kind`] if the frame is of another size or format than the reference.
    pub fn track(&self, frame: &Frame) -> Result<Vec<Tracked>, FeatureError> {
        if frame.info() != self.info {
            return Err(FeatureError::Kind {
                expected: self.info,
                found: frame.info(),
            });
        }
        Ok(self.follow(frame))
    }

    /// The same of a frame whose size and format were checked.
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

    /// Pairs of a marker and a spot that may be one, the likeliest first: markers that seem to have moved least, and the spots near to each.
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
