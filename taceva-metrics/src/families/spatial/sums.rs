//! Sums of errors by distance from the sensor's axis and by depth.

use taceva_core::{Footprint, Nanometre};

use crate::exact::merge::{Merge, keyed, merge_cells};
use crate::exact::moments::Moments;
use crate::exact::record::Record;
use crate::exact::sorted_map::SortedMap;
use crate::pair::{Paired, is_valid};

/// Number of bins of distance, and number of bins of depth.
pub(super) const BINS: u8 = 100;

/// Absolute errors of one channel, grouped by distance from the sensor's axis and by depth. Bins without samples are absent.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct SpatialSums {
    pub(super) n: u64,
    pub(super) n_invalid: u64,
    /// Number of samples outside the radius or the depth range of the footprint.
    pub(super) outside: u64,
    pub(super) distance: SortedMap<u8, Moments>,
    pub(super) depth: SortedMap<u8, Moments>,
}

impl SpatialSums {
    pub(super) fn add(&mut self, pair: Paired<f64>, place_mm: [f64; 3], reach: Reach) {
        if !pair.is_valid() || !place_mm.into_iter().all(is_valid) {
            self.n_invalid += 1;
            return;
        }
        let Some((distance, depth)) = reach.bins(place_mm) else {
            self.outside += 1;
            return;
        };
        let error = pair.residual().abs();
        self.n += 1;
        self.distance.entry(distance).add(error);
        self.depth.entry(depth).add(error);
    }

    pub(super) fn to_record(&self) -> Record {
        let cells = |axis: &'static str, bins: &SortedMap<u8, Moments>| {
            let bins = bins.iter();
            bins.map(|(bin, moments)| (format!("{axis} {bin:02}"), moments.to_record()))
                .collect::<Vec<_>>()
        };
        let distance = cells("distance", &self.distance);
        Record {
            counts: vec![self.n, self.n_invalid, self.outside],
            cells: keyed(distance.into_iter().chain(cells("depth", &self.depth))),
            ..Record::default()
        }
    }

    pub(super) fn read_record(record: &Record) -> Result<SpatialSums, String> {
        let ([n, n_invalid, outside], []) = record.with_cells()?;
        let parse = |key: &str| {
            let (axis, bin) = key.split_once(' ')?;
            let axis = ["distance", "depth"]
                .into_iter()
                .position(|known| known == axis)?;
            let bin = bin.parse().ok().filter(|bin| *bin < BINS)?;
            Some((axis, bin))
        };
        let cells = record.read_cells(parse, |cell| {
            Moments::read_record(cell).and_then(|moments| match moments.n {
                0 => Err("a bin without samples, expected at least one".to_owned()),
                _ => Ok(moments),
            })
        })?;
        let mut sums = SpatialSums {
            n: *n,
            n_invalid: *n_invalid,
            outside: *outside,
            ..SpatialSums::default()
        };
        for (&(axis, bin), moments) in &cells {
            let bins = if axis == 0 {
                &mut sums.distance
            } else {
                &mut sums.depth
            };
            bins.insert(bin, moments.clone());
        }
        for bins in [&sums.distance, &sums.depth] {
            let binned = bins
                .values()
                .fold(0, |all: u64, bin| all.saturating_add(bin.n));
            if binned != sums.n {
                return Err(format!("{binned} samples in bins, expected {n}"));
            }
        }
        Ok(sums)
    }
}

impl Merge for SpatialSums {
    fn merge(&mut self, other: &SpatialSums) {
        self.n = self.n.saturating_add(other.n);
        self.n_invalid = self.n_invalid.saturating_add(other.n_invalid);
        self.outside = self.outside.saturating_add(other.outside);
        merge_cells(&mut self.distance, &other.distance);
        merge_cells(&mut self.depth, &other.depth);
    }
}

/// Greatest distance from the sensor's axis and greatest depth, of a footprint.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reach {
    pub(super) radius: Nanometre,
    pub(super) depth: Nanometre,
}

impl Reach {
    /// Greatest distance and depth of `footprint`; `None` if the footprint declares no depth.
    pub(super) fn of(footprint: &Footprint) -> Option<Reach> {
        Some(Reach {
            radius: footprint.reach(),
            depth: footprint.depth_max()?,
        })
    }

    /// Bins of distance and depth for a place in mm, computed in whole nanometres; `None` outside the radius or the depth range.
    ///
    /// The distance r is in bin ⌊100 r / `radius`⌋, the depth z in bin ⌊100 z / `depth`⌋. Both are at most 99.
    fn bins(self, place_mm: [f64; 3]) -> Option<(u8, u8)> {
        let [x, y, z] = place_mm.map(Nanometre::from_millimetres);
        let (x, y, z) = (x?, y?, z?);
        let square = |length: i64| u128::from(length.unsigned_abs()).pow(2);
        let squared = square(x.0) + square(y.0);
        if squared > square(self.radius.0) || z.0 < 0 || z.0 > self.depth.0 {
            return None;
        }
        let bins = u128::from(BINS);
        let ring = (bins * bins * squared).isqrt() / u128::from(self.radius.0.unsigned_abs());
        let level = u128::from(z.0.unsigned_abs()) * bins / u128::from(self.depth.0.unsigned_abs());
        let last = |bin: u128| u8::try_from(bin.min(bins - 1)).expect("at most 99");
        Some((last(ring), last(level)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const REACH: Reach = Reach {
        radius: Nanometre(12_500_000),
        depth: Nanometre(1_000_000),
    };

    #[test]
    fn a_hundredth_belongs_to_the_bin_it_opens() {
        // In binary64 ⌊100 × 0.29⌋ is 28, and 57 and 58 fall short too.
        for bin in 0..=99_u8 {
            let share = f64::from(bin) / 100.0;
            let found = REACH.bins([12.5 * share, 0.0, share]);
            assert_eq!(found, Some((bin, bin)));
        }
        assert_eq!(REACH.bins([12.5, 0.0, 1.0]), Some((99, 99)));
    }

    #[test]
    fn what_lies_beyond_is_in_no_bin() {
        for place in [
            [12.500_001, 0.0, 0.5],
            [0.0, 0.0, 1.000_001],
            [0.0, 0.0, -0.000_001],
        ] {
            assert_eq!(REACH.bins(place), None, "{place:?}");
        }
        assert_eq!(REACH.bins([-7.5, 10.0, 0.0]), Some((99, 0)));
    }
}
