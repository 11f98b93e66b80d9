//! How often a spacing was missed by how much.

use std::collections::BTreeMap;

use crate::exact::Dyadic;
use crate::merge::Merge;
use crate::state::Record;

/// Counts of samples by |r̂ − r| in whole nanometres: every tolerance can be asked afterwards.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Histogram {
    pub(super) n_invalid: u64,
    /// Samples by difference; only differences that came.
    counts: BTreeMap<u64, u64>,
}

impl Histogram {
    /// Adds a sample that missed by `difference_nm`.
    pub(super) fn add(&mut self, difference_nm: u64) {
        *self.counts.entry(difference_nm).or_default() += 1;
    }

    /// Number of samples.
    pub(super) fn n(&self) -> u64 {
        let counts = self.counts.values();
        counts.fold(0, |n, &count| n.saturating_add(count))
    }

    /// Samples that missed by at most `tolerance_nm`.
    pub(super) fn hits(&self, tolerance_nm: u64) -> u64 {
        let within = self.counts.range(..=tolerance_nm);
        within.fold(0, |hits, (_, &count)| hits.saturating_add(count))
    }

    /// RN(hits / n); `None` for no sample.
    pub(super) fn rate(&self, tolerance_nm: u64) -> Option<f64> {
        let n = self.n();
        (n > 0).then(|| Dyadic::from(self.hits(tolerance_nm)).over(&Dyadic::from(n)))
    }

    /// As a state holds it: invalid samples, then each difference followed by its count.
    pub(super) fn to_record(&self) -> Record {
        let counts = self.counts.iter();
        let counts = counts.flat_map(|(&difference, &count)| [difference, count]);
        Record {
            counts: std::iter::once(self.n_invalid).chain(counts).collect(),
            ..Record::default()
        }
    }

    /// Back from a state.
    pub(super) fn read_record(record: &Record) -> Result<Histogram, String> {
        if !(record.sums.is_empty() && record.values.is_empty() && record.cells.is_empty()) {
            return Err("sums, values or cells beside counts".to_owned());
        }
        let Some((&n_invalid, counts)) = record.counts.split_first() else {
            return Err("no counts, expected at least one".to_owned());
        };
        let mut histogram = Histogram {
            n_invalid,
            counts: BTreeMap::new(),
        };
        for pair in counts.chunks(2) {
            let &[difference, count] = pair else {
                return Err(format!("difference {} without a count", pair[0]));
            };
            let last = histogram.counts.last_key_value();
            if count == 0 || last.is_some_and(|(&last, _)| last >= difference) {
                return Err(format!(
                    "difference {difference} with {count} samples, expected ascending ones that came"
                ));
            }
            histogram.counts.insert(difference, count);
        }
        Ok(histogram)
    }
}

impl Merge for Histogram {
    fn merge(&mut self, other: &Histogram) {
        self.n_invalid = self.n_invalid.saturating_add(other.n_invalid);
        for (&difference, &count) in &other.counts {
            let ours = self.counts.entry(difference).or_default();
            *ours = ours.saturating_add(count);
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
            .for_each(|difference| histogram.add(difference));
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
}
