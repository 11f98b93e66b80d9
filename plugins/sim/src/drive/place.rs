//! Keys of places and visits for the random numbers of the bench.

use std::collections::BTreeMap;

use taceva_core::Nanometre;

use crate::random::{Purpose, Random, Stream};

/// Number of visits to each place.
#[derive(Debug, Default)]
pub(super) struct Visits {
    counts: BTreeMap<[Nanometre; 2], u64>,
}

/// Keys of a place and of one visit to it, for random numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct VisitKey {
    pub(super) place: [Nanometre; 2],
    pub(super) point: u64,
    pub(super) visit: u64,
}

impl Visits {
    /// Key of the next visit to a place in mm.
    pub(super) fn next(&mut self, place_mm: [f64; 2]) -> VisitKey {
        let place = nanometres(place_mm);
        let count = self.counts.entry(place).or_default();
        *count += 1;
        let names = names(place);
        VisitKey {
            place,
            point: names.bits(0),
            visit: names.bits(*count),
        }
    }
}

/// Key of a place.
pub(super) fn point_of(place_mm: [f64; 2]) -> u64 {
    names(nanometres(place_mm)).bits(0)
}

/// Random stream of the keys of a place and of its visits.
fn names(place: [Nanometre; 2]) -> Stream {
    let [x, y] = place.map(|side| side.0.cast_unsigned());
    Random::new(x).stream(Purpose::Draws, y)
}

/// Converts a place to whole nanometres. A coordinate out of range becomes 0.
pub(super) fn nanometres(place_mm: [f64; 2]) -> [Nanometre; 2] {
    place_mm.map(|side| Nanometre::from_millimetres(side).unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_visit_is_named_by_its_place_and_number_whatever_happened_elsewhere() {
        let (mut busy, mut idle) = (Visits::default(), Visits::default());
        for _ in 0..5 {
            busy.next([7.0, 7.0]);
        }
        let [first, second] = [busy.next([1.0, -2.0]), busy.next([1.0, -2.0])];
        assert_eq!(first, idle.next([1.0, -2.0]));
        assert_ne!(first.visit, second.visit);
        assert_eq!(first.point, second.point);
    }
}
