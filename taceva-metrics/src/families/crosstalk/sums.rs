//! Sums over truths x and predictions y of several channels, and over their products.

use crate::exact::merge::Merge;
use crate::exact::record::Record;
use crate::exact::{ColumnSums, Dyadic, ExactSum};
use crate::pair::is_valid;

/// Counts, exact sums of truths x, predictions y and their products, and the range of each truth.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct JointSums {
    channels: usize,
    n: u64,
    n_invalid: u64,
    /// Σ x_j over the truths of each channel j, then Σ y_i over the predictions of each channel i.
    values: Vec<ExactSum>,
    /// Σ x_k x_j over the truths of channels k ≤ j, row by row. Then Σ y_i x_j with the prediction y_i, row by row of i.
    products: Vec<ExactSum>,
    /// Least and greatest truth of each channel; empty without samples.
    ranges: Vec<[f64; 2]>,
}

/// Pairs of columns to multiply, for `channels` truths followed by as many predictions.
pub(super) fn products(channels: usize) -> Vec<[usize; 2]> {
    let truths = (0..channels).flat_map(|k| (k..channels).map(move |j| [k, j]));
    let shared = (0..channels).flat_map(|i| (0..channels).map(move |j| [channels + i, j]));
    truths.chain(shared).collect()
}

impl JointSums {
    /// Empty sums of `channels` channels.
    pub(super) fn new(channels: usize) -> JointSums {
        JointSums {
            channels,
            n: 0,
            n_invalid: 0,
            values: vec![ExactSum::default(); 2 * channels],
            products: vec![ExactSum::default(); products(channels).len()],
            ranges: Vec::new(),
        }
    }

    /// Adds `samples` to the number of samples.
    pub(super) fn count(&mut self, samples: usize) {
        self.n += u64::try_from(samples).expect("no column has 2^64 rows");
    }

    fn widen(&mut self, ranges: &[[f64; 2]]) {
        if self.ranges.is_empty() {
            self.ranges = ranges.to_vec();
            return;
        }
        for (range, other) in self.ranges.iter_mut().zip(ranges) {
            *range = [range[0].min(other[0]), range[1].max(other[1])];
        }
    }

    /// Number of channels.
    pub(super) fn channels(&self) -> usize {
        self.channels
    }

    /// Number of samples.
    pub(super) fn n(&self) -> u64 {
        self.n
    }

    /// Number of skipped samples.
    pub(super) fn n_invalid(&self) -> u64 {
        self.n_invalid
    }

    /// Least and greatest truth of channel `j`; `None` without samples.
    pub(super) fn range(&self, j: usize) -> Option<[f64; 2]> {
        self.ranges.get(j).copied()
    }

    /// n Σ x_k x_j − Σ x_k Σ x_j over n truths of channels `k` and `j`, exact.
    pub(super) fn truth_products(&self, k: usize, j: usize) -> Dyadic {
        let (k, j) = (k.min(j), k.max(j));
        let row_start = k * self.channels - k * (k + 1) / 2;
        self.centred(&self.products[row_start + j], [k, j])
    }

    /// n Σ y_i x_j − Σ y_i Σ x_j over n predictions of channel `i` and truths of channel `j`, exact.
    pub(super) fn shared_products(&self, i: usize, j: usize) -> Dyadic {
        let truths = self.channels * (self.channels + 1) / 2;
        let products = &self.products[truths + i * self.channels + j];
        self.centred(products, [self.channels + i, j])
    }

    fn centred(&self, products: &ExactSum, of: [usize; 2]) -> Dyadic {
        let [left, right] = of.map(|value| self.values[value].to_dyadic());
        &(&Dyadic::from(self.n) * &products.to_dyadic()) - &(&left * &right)
    }

    /// Converts the sums to a record for a saved state.
    pub(super) fn to_record(&self) -> Record {
        Record {
            counts: vec![self.n, self.n_invalid],
            sums: [&self.values[..], &self.products].concat(),
            values: self.ranges.concat(),
            ..Record::default()
        }
    }

    /// Reads the sums of `channels` channels from a record of a saved state.
    pub(super) fn read_record(record: &Record, channels: usize) -> Result<JointSums, String> {
        let mut sums = JointSums::new(channels);
        let expected = sums.values.len() + sums.products.len();
        let [n, n_invalid] = record.counts[..] else {
            return Err(format!("{} counts, expected 2", record.counts.len()));
        };
        if record.sums.len() != expected || !record.cells.is_empty() {
            return Err(format!("{} sums, expected {expected}", record.sums.len()));
        }
        let ranges: Vec<[f64; 2]> = record
            .values
            .chunks_exact(2)
            .map(|pair| [pair[0], pair[1]])
            .collect();
        let ascending =
            |range: &[f64; 2]| is_valid(range[0]) && is_valid(range[1]) && range[0] <= range[1];
        let ranged = if n == 0 { 0 } else { channels };
        if record.values.len() != 2 * ranged || !ranges.iter().all(ascending) {
            return Err(format!(
                "{} values, expected the two ends of {ranged} ranges in ascending order",
                record.values.len()
            ));
        }
        let (values, products) = record.sums.split_at(sums.values.len());
        (sums.values, sums.products) = (values.to_vec(), products.to_vec());
        (sums.n, sums.n_invalid, sums.ranges) = (n, n_invalid, ranges);
        Ok(sums)
    }
}

impl ColumnSums for JointSums {
    fn sums(&mut self) -> [&mut [ExactSum]; 2] {
        [&mut self.values, &mut self.products]
    }

    fn take(&mut self, columns: &[&[f64]]) {
        self.count(columns.first().map_or(0, |column| column.len()));
        let range = |column: &&[f64]| {
            let first = [column[0]; 2];
            let wider = |[low, high]: [f64; 2], value: &f64| [low.min(*value), high.max(*value)];
            // Zeros get one sign, so that equal sets have equal ranges.
            column.iter().fold(first, wider).map(|end| end + 0.0)
        };
        let truths = columns.iter().take(self.channels);
        let ranges: Vec<[f64; 2]> = truths.map(range).collect();
        self.widen(&ranges);
    }

    fn leave_out(&mut self) {
        self.n_invalid += 1;
    }
}

impl Merge for JointSums {
    fn merge(&mut self, other: &JointSums) {
        self.n = self.n.saturating_add(other.n);
        self.n_invalid = self.n_invalid.saturating_add(other.n_invalid);
        self.values.merge(&other.values);
        self.products.merge(&other.products);
        if !other.ranges.is_empty() {
            self.widen(&other.ranges);
        }
    }
}
