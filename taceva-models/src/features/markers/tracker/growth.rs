//! Matches markers and spots, from neighbour to neighbour.

use super::{MarkerTracker, Tracked};
use crate::features::markers::local::{Moved, displacement};
use crate::features::markers::spots::distance;

/// Largest distance of a marker from its predicted position, in marker spacings. The value is below half, so that no spot matches two markers.
const REACH: f64 = 0.4;

/// Partial match of markers to spots.
#[derive(Clone, Debug)]
pub(super) struct Growth<'a> {
    tracker: &'a MarkerTracker,
    found: &'a [[f64; 2]],
    spot_of: Vec<Option<usize>>,
    is_taken: Vec<bool>,
}

impl<'a> Growth<'a> {
    pub(super) fn new(tracker: &'a MarkerTracker, found: &'a [[f64; 2]]) -> Growth<'a> {
        Growth {
            tracker,
            found,
            spot_of: vec![None; tracker.places.len()],
            is_taken: vec![false; found.len()],
        }
    }

    /// Matches `seed` with `spot`. Then repeatedly takes the marker with the most matched neighbours, and matches it with the spot at its predicted
    /// position.
    pub(super) fn grow_from(&mut self, seed: usize, spot: usize) {
        let count = self.spot_of.len();
        let mut is_asked = vec![false; count];
        let mut votes = vec![0_usize; count];
        let mut next = Some((seed, Some(spot)));
        while let Some((own, spot)) = next {
            is_asked[own] = true;
            if let Some(spot) = spot {
                self.spot_of[own] = Some(spot);
                self.is_taken[spot] = true;
                for &near in &self.tracker.neighbours[own] {
                    votes[near] += 1;
                }
            }
            // Ties go to the marker of higher contrast, which comes first.
            let open = (0..count).filter(|other| !is_asked[*other] && votes[*other] > 0);
            let own = open.reduce(|best, other| {
                if votes[other] > votes[best] {
                    other
                } else {
                    best
                }
            });
            next = own.map(|own| (own, self.spot_where_expected(own)));
        }
        self.mend();
    }

    /// Removes matches that contradict matches of neighbours. Then searches a spot for each unmatched marker.
    fn mend(&mut self) {
        for own in 0..self.spot_of.len() {
            let Some(spot) = self.spot_of[own] else {
                continue;
            };
            let expected = self.expected(own);
            if expected
                .is_some_and(|expected| distance(expected, self.found[spot]) > self.reach(own))
            {
                self.is_taken[spot] = false;
                self.spot_of[own] = None;
            }
        }
        for own in 0..self.spot_of.len() {
            if self.spot_of[own].is_none()
                && let Some(spot) = self.spot_where_expected(own)
            {
                self.spot_of[own] = Some(spot);
                self.is_taken[spot] = true;
            }
        }
    }

    /// Number of markers without a matched spot.
    pub(super) fn unseen(&self) -> usize {
        self.spot_of.iter().filter(|spot| spot.is_none()).count()
    }

    /// Cost of the match: the number of unmatched markers, plus `movement` times the sum of squared displacements in spacings.
    pub(super) fn cost(&self, movement: f64) -> f64 {
        let moved = (0..self.spot_of.len()).filter_map(|own| {
            let [right, down] = self.moved(own)?.1;
            let spacing_px = self.tracker.lattice.spacings_px[own];
            Some((right * right + down * down) / (spacing_px * spacing_px))
        });
        self.unseen() as f64 + movement * moved.sum::<f64>()
    }

    /// Tracking result of each marker.
    pub(super) fn tracked(&self) -> Vec<Tracked> {
        let all: Vec<Moved> = (0..self.spot_of.len())
            .filter_map(|own| self.moved(own))
            .collect();
        let of = |own: usize| match self.moved(own) {
            Some((_, displacement_px)) => Tracked {
                displacement_px,
                is_seen: true,
            },
            None => Tracked {
                displacement_px: self.displacement(own, &all),
                is_seen: false,
            },
        };
        (0..self.spot_of.len()).map(of).collect()
    }

    /// Displacement of the marker `own`, in pixels, predicted from seen markers nearby or else from all seen markers; 0 if none is seen.
    fn displacement(&self, own: usize, all: &[Moved]) -> [f64; 2] {
        let place = self.tracker.places[own];
        let spacing_px = self.tracker.lattice.spacings_px[own];
        displacement(place, spacing_px, &self.around(own))
            .or_else(|| displacement(place, spacing_px, all))
            .unwrap_or([0.0; 2])
    }

    fn spot_where_expected(&self, own: usize) -> Option<usize> {
        let expected = self.expected(own)?;
        let free = (0..self.found.len()).filter(|spot| !self.is_taken[*spot]);
        let off = free.map(|spot| (distance(expected, self.found[spot]), spot));
        let (off, spot) = off.reduce(|best, next| if next.0 < best.0 { next } else { best })?;
        (off <= self.reach(own)).then_some(spot)
    }

    /// Predicted position of the marker `own`, in pixels; `None` if no marker nearby is seen.
    fn expected(&self, own: usize) -> Option<[f64; 2]> {
        let place = self.tracker.places[own];
        let spacing_px = self.tracker.lattice.spacings_px[own];
        let [right, down] = displacement(place, spacing_px, &self.around(own))?;
        Some([place[0] + right, place[1] + down])
    }

    /// Seen markers among the neighbours of `own` and the neighbours of these neighbours.
    fn around(&self, own: usize) -> Vec<Moved> {
        let neighbours = &self.tracker.neighbours;
        let further = neighbours[own].iter().flat_map(|near| &neighbours[*near]);
        let mut around: Vec<usize> = neighbours[own].iter().chain(further).copied().collect();
        around.sort_unstable();
        around.dedup();
        around.retain(|other| *other != own);
        around
            .into_iter()
            .filter_map(|other| self.moved(other))
            .collect()
    }

    fn moved(&self, own: usize) -> Option<Moved> {
        let [x, y] = self.tracker.places[own];
        let found = self.found[self.spot_of[own]?];
        Some(([x, y], [found[0] - x, found[1] - y]))
    }

    fn reach(&self, own: usize) -> f64 {
        REACH * self.tracker.lattice.spacings_px[own]
    }
}
