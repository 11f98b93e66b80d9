//! What is kept of several channels together: x the truths, y the predictions.

use crate::evaluate::state::Record;
use crate::exact::merge::Merge;
use crate::exact::{Dyadic, ExactSum};
use crate::paired::{Paired, is_valid};

/// Counts, exact sums of values and products, and the range of each truth.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct JointSums {
    channels: usize,
    n: u64,
    n_invalid: u64,
    /// Σ x_j, then Σ y_i.
    values: Vec<ExactSum>,
    /// Σ x_k x_j, row by row of k ≤ j.
    truths: Vec<ExactSum>,
    /// Σ y_i x_j, row by row of i.
    shared: Vec<ExactSum>,
    /// Least and greatest x_j.
    ranges: Vec<[f64; 2]>,
}

impl JointSums {
    /// The sums of no sample of so many channels.
    pub(super) fn new(channels: usize) -> JointSums {
        JointSums {
            channels,
            n: 0,
            n_invalid: 0,
            values: vec![ExactSum::default(); 2 * channels],
            truths: vec![ExactSum::default(); channels * (channels + 1) / 2],
            shared: vec![ExactSum::default(); channels * channels],
            ranges: Vec::new(),
        }
    }

    /// Adds a sample, one pair per channel; if a value is no usable number, the sample is counted and left out.
    pub(super) fn add(&mut self, pairs: &[Paired<f64>]) {
        if !pairs.iter().all(|pair| pair.is_valid()) {
            self.n_invalid += 1;
            return;
        }
        self.n += 1;
        let truths = || pairs.iter().map(|pair| pair.reference);
        let estimates = || pairs.iter().map(|pair| pair.estimate);
        for (sum, value) in self.values.iter_mut().zip(truths().chain(estimates())) {
            sum.add(value);
        }
        let products = truths()
            .enumerate()
            .flat_map(|(row, left)| truths().skip(row).map(move |right| (left, right)));
        for (sum, (left, right)) in self.truths.iter_mut().zip(products) {
            sum.add_product(left, right);
        }
        let products = estimates().flat_map(|left| truths().map(move |right| (left, right)));
        for (sum, (left, right)) in self.shared.iter_mut().zip(products) {
            sum.add_product(left, right);
        }
        // A zero has one sign here, or equal sets would have two ranges.
        let ranges: Vec<[f64; 2]> = truths().map(|truth| [truth + 0.0; 2]).collect();
        self.widen(&ranges);
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

    /// Number of samples left out.
    pub(super) fn n_invalid(&self) -> u64 {
        self.n_invalid
    }

    /// The range of truth `j`, which has one if there is a sample.
    pub(super) fn range(&self, j: usize) -> Option<[f64; 2]> {
        self.ranges.get(j).copied()
    }

    /// n Σ x_k x_j − Σ x_k Σ x_j, exactly.
    pub(super) fn truth_products(&self, k: usize, j: usize) -> Dyadic {
        let (k, j) = (k.min(j), k.max(j));
        let row_start = k * self.channels - k * (k + 1) / 2;
        self.centred(&self.truths[row_start + j], [k, j])
    }

    /// n Σ y_i x_j − Σ y_i Σ x_j, exactly.
    pub(super) fn shared_products(&self, i: usize, j: usize) -> Dyadic {
        self.centred(&self.shared[i * self.channels + j], [self.channels + i, j])
    }

    fn centred(&self, products: &ExactSum, of: [usize; 2]) -> Dyadic {
        let [left, right] = of.map(|value| self.values[value].to_dyadic());
        &(&Dyadic::from(self.n) * &products.to_dyadic()) - &(&left * &right)
    }

    /// As a state holds it.
    pub(super) fn to_record(&self) -> Record {
        Record {
            counts: vec![self.n, self.n_invalid],
            sums: [&self.values[..], &self.truths, &self.shared].concat(),
            values: self.ranges.concat(),
            ..Record::default()
        }
    }

    /// Back from a state of so many channels.
    pub(super) fn read_record(record: &Record, channels: usize) -> Result<JointSums, String> {
        let mut sums = JointSums::new(channels);
        let lengths = [sums.values.len(), sums.truths.len(), sums.shared.len()];
        let expected: usize = lengths.iter().sum();
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
                "{} values, expected {ranged} ranges",
                record.values.len()
            ));
        }
        let (values, products) = record.sums.split_at(lengths[0]);
        let (truths, shared) = products.split_at(lengths[1]);
        sums.values = values.to_vec();
        sums.truths = truths.to_vec();
        sums.shared = shared.to_vec();
        (sums.n, sums.n_invalid, sums.ranges) = (n, n_invalid, ranges);
        Ok(sums)
    }
}

impl Merge for JointSums {
    fn merge(&mut self, other: &JointSums) {
        self.n = self.n.saturating_add(other.n);
        self.n_invalid = self.n_invalid.saturating_add(other.n_invalid);
        self.values.merge(&other.values);
        self.truths.merge(&other.truths);
        self.shared.merge(&other.shared);
        if !other.ranges.is_empty() {
            self.widen(&other.ranges);
        }
    }
}
