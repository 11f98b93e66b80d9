//! Histogram of spacing errors.

use std::collections::BTreeMap;

use crate::exact::Dyadic;
use crate::exact::merge::{Merge, keyed};
use crate::exact::record::Record;

/// Counts of samples by magnitude of the spacing error, in whole nanometres. Any tolerance can be applied to them later. Counts by true spacing
/// give the success rate of the best constant prediction.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Histogram {
    pub(super) n_invalid: u64,
    /// Number of samples for each magnitude of error, nm. Errors that do not occur have no entry.
    counts: BTreeMap<u64, u64>,
    /// Number of samples for each true spacing, nm. Empty if read from an older state without these counts.
    truths: BTreeMap<u64, u64>,
}

/// Name of the record's cell with the counts of true spacings.
const TRUTHS: &str = "truth";

impl Histogram {
    /// Adds a sample with the true spacing `truth_nm` and the predicted spacing `estimate_nm`.
    pub(super) fn add(&mut self, truth_nm: i64, estimate_nm: i64) {
        *self
            .counts
            .entry(truth_nm.abs_diff(estimate_nm))
            .or_default() += 1;
        if let Ok(truth) = u64::try_from(truth_nm) {
            *self.truths.entry(truth).or_default() += 1;
        }
    }

    /// Success rate of the best constant prediction: the greatest share of true spacings within `tolerance_nm` of one value. `None` without
    /// samples, or if a true spacing is unknown.
    pub(super) fn of_constant(&self, tolerance_nm: u64) -> Option<f64> {
        let known = self
            .truths
            .values()
            .fold(0, |n: u64, &count| n.saturating_add(count));
        let n = self.n();
        if n == 0 || known != n {
            return None;
        }
        let width = tolerance_nm.saturating_mul(2);
        let within = |&first: &u64| {
            let own = self.truths.range(first..=first.saturating_add(width));
            own.fold(0, |hits: u64, (_, &count)| hits.saturating_add(count))
        };
        let most = self.truths.keys().map(within).max()?;
        Some(Dyadic::from(most).over(&Dyadic::from(n)))
    }

    /// Number of samples.
    pub(super) fn n(&self) -> u64 {
        let counts = self.counts.values();
        counts.fold(0, |n, &count| n.saturating_add(count))
    }

    /// Number of samples with an error of at most `tolerance_nm`.
    pub(super) fn hits(&self, tolerance_nm: u64) -> u64 {
        let within = self.counts.range(..=tolerance_nm);
        within.fold(0, |hits, (_, &count)| hits.saturating_add(count))
    }

    /// Share of samples with an error of at most `tolerance_nm`; `None` without samples.
    pub(super) fn rate(&self, tolerance_nm: u64) -> Option<f64> {
        let n = self.n();
        (n > 0).then(|| Dyadic::from(self.hits(tolerance_nm)).over(&Dyadic::from(n)))
    }

    /// Converts the histogram to its record in a stored evaluation state. The record's counts are the number of invalid samples, then each error
    /// followed by its number of samples. A cell lists true spacings in the same way.
    pub(super) fn to_record(&self) -> Record {
        let flat = |counts: &BTreeMap<u64, u64>| {
            let counts = counts.iter();
            let counts = counts.flat_map(|(&number, &count)| [number, count]);
            counts.collect::<Vec<u64>>()
        };
        let truths = (!self.truths.is_empty()).then(|| {
            let record = Record {
                counts: flat(&self.truths),
                ..Record::default()
            };
            (TRUTHS.to_owned(), record)
        });
        Record {
            counts: [vec![self.n_invalid], flat(&self.counts)].concat(),
            cells: keyed(truths),
            ..Record::default()
        }
    }

    /// Reads a histogram from its record in a stored evaluation state.
    pub(super) fn read_record(record: &Record) -> Result<Histogram, String> {
        if !(record.sums.is_empty() && record.values.is_empty()) {
            return Err("the record has sums or values, expected counts only".to_owned());
        }
        let Some((&n_invalid, counts)) = record.counts.split_first() else {
            return Err("no counts, expected at least one".to_owned());
        };
        let mut truths = BTreeMap::new();
        for (name, cell) in &record.cells {
            let is_bare = cell.sums.is_empty() && cell.values.is_empty() && cell.cells.is_empty();
            if name != TRUTHS || !is_bare {
                return Err(format!("cell `{name}`, expected counts of true spacings"));
            }
            truths = read_counts(&cell.counts, "spacing")?;
        }
        Ok(Histogram {
            n_invalid,
            counts: read_counts(counts, "difference")?,
            truths,
        })
    }
}

/// Reads ascending numbers, each followed by its count. Error messages call these numbers `what`.
fn read_counts(counts: &[u64], what: &str) -> Result<BTreeMap<u64, u64>, String> {
    let mut read = BTreeMap::new();
    for pair in counts.chunks(2) {
        let &[number, count] = pair else {
            return Err(format!("{what} {} without a count", pair[0]));
        };
        let last = read.last_key_value();
        if count == 0 || last.is_some_and(|(&last, _)| last >= number) {
            return Err(format!(
                "{what} {number} with {count} samples, expected ascending numbers and counts from 1"
            ));
        }
        read.insert(number, count);
    }
    Ok(read)
}

impl Merge for Histogram {
    fn merge(&mut self, other: &Histogram) {
        self.n_invalid = self.n_invalid.saturating_add(other.n_invalid);
        for (ours, others) in [
            (&mut self.counts, &other.counts),
            (&mut self.truths, &other.truths),
        ] {
            for (&number, &count) in others {
                let ours = ours.entry(number).or_default();
                *ours = ours.saturating_add(count);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tolerance_includes_its_own_end() {
        let mut histogram = Histogram::default();
        [0, 50_000, 50_001]
            .into_iter()
            .for_each(|difference| histogram.add(0, difference));
        let hits = [0, 49_999, 50_000, u64::MAX].map(|tolerance| histogram.hits(tolerance));
        assert_eq!(hits, [1, 1, 2, 3]);
        assert_eq!(Histogram::default().rate(0), None);
    }

    #[test]
    fn records_that_no_histogram_has_are_refused() {
        let read = |counts: &[u64]| {
            Histogram::read_record(&Record {
                counts: counts.to_vec(),
                ..Record::default()
            })
        };
        for broken in [
            &[][..],
            &[0, 5],
            &[0, 5, 0],
            &[0, 5, 1, 5, 1],
            &[0, 5, 1, 4, 1],
        ] {
            assert!(read(broken).is_err(), "{broken:?}");
        }
        let whole = read(&[2, 4, 1, 5, 3]).expect("a histogram");
        assert_eq!(whole.to_record().counts, [2, 4, 1, 5, 3]);
    }

    #[test]
    fn the_best_constant_answer_hits_what_lies_in_one_window() {
        let mut histogram = Histogram::default();
        for truth in [350_000, 400_000, 450_000, 450_000, 1_000_000] {
            histogram.add(truth, 0);
        }
        let of = |tolerance: u64| histogram.of_constant(tolerance);
        assert_eq!([of(0), of(25_000), of(49_999)], [0.4, 0.6, 0.6].map(Some));
        assert_eq!(of(50_000), Some(0.8));
        assert_eq!(Histogram::default().of_constant(0), None);
        let again = Histogram::read_record(&histogram.to_record()).expect("a histogram");
        assert_eq!(again, histogram);
    }

    #[test]
    fn a_state_of_before_skill_does_not_say_what_a_constant_would_reach() {
        let old = Record {
            counts: vec![0, 0, 4],
            ..Record::default()
        };
        let mut histogram = Histogram::read_record(&old).expect("a histogram");
        assert_eq!(histogram.of_constant(0), None);
        histogram.add(1, 1);
        assert_eq!(histogram.of_constant(0), None);
    }
}
