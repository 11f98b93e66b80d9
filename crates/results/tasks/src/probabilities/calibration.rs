//! Calibration error: distance of predicted probabilities from observed shares.

use taceva_metrics::{Dyadic, ExactSum};

use crate::ranking::{Level, Sides};
use crate::undefined::Undefined;

/// Number of bins of equal numbers of samples.
pub(super) const BINS: u64 = 15;

/// Expected calibration error in [`BINS`] bins of equal numbers of samples. `levels` are the counts of each probability, ascending.
///
/// Samples of equal probability share the bin of their middle sample, so the error does not depend on their order. Levels without
/// samples change nothing.
pub(super) fn expected_error(levels: &[Level]) -> Result<f64, Undefined> {
    let n = Sides::of(levels).n();
    if n == 0 {
        return Err(Undefined::Empty);
    }
    let mut sum = ExactSum::default();
    let mut bins = Bins::default();
    let mut below = 0;
    for level in levels {
        let count = level.positive + level.negative;
        let bin =
            u128::from(BINS) * (2 * u128::from(below) + u128::from(count)) / (2 * u128::from(n));
        if bin != bins.at {
            bins.close_into(&mut sum);
            bins.at = bin;
        }
        below += count;
        bins.add(level);
    }
    bins.close_into(&mut sum);
    Ok(sum.to_dyadic().over(&Dyadic::from(n)))
}

/// Current bin, and its number of positive samples minus the sum of its predicted probabilities.
#[derive(Default)]
struct Bins {
    at: u128,
    sum: ExactSum,
}

impl Bins {
    fn add(&mut self, level: &Level) {
        let [positive, count] = [level.positive, level.positive + level.negative].map(number);
        self.sum.add(positive);
        self.sum.add_product(-count, level.score);
    }

    /// Adds the magnitude of the sum of the bin to `all`, and begins a new bin.
    fn close_into(&mut self, all: &mut ExactSum) {
        let sum = std::mem::take(&mut self.sum);
        match sum.to_dyadic().is_negative() {
            true => all.subtract(&sum),
            false => all.merge(&sum),
        }
    }
}

/// `count` as a number, exact below 2⁵³.
fn number(count: u64) -> f64 {
    Dyadic::from(count).to_f64()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn level(score: f64, positive: u64, negative: u64) -> Level {
        Level {
            score,
            positive,
            negative,
        }
    }

    #[test]
    fn each_bin_adds_its_own_distance() {
        // Two levels of as many samples: bins 3 and 11. |1 − 0.5| and |0 − 0.25|, each for half of the samples.
        let levels = [level(0.25, 0, 4), level(0.5, 4, 0)];
        assert_eq!(expected_error(&levels), Ok(0.375));
    }

    #[test]
    fn levels_without_samples_add_nothing() {
        let levels = [(0.25, 0, 4), (0.375, 0, 0), (0.5, 4, 0), (0.75, 0, 0)];
        let levels = levels.map(|(score, positive, negative)| level(score, positive, negative));
        assert_eq!(expected_error(&levels), Ok(0.375));
    }

    #[test]
    fn distances_within_a_bin_cancel() {
        // Thirty levels of one sample: two in each bin.
        let mut levels: Vec<Level> = (0..30).map(|_| level(0.5, 0, 0)).collect();
        for (at, level) in levels.iter_mut().enumerate() {
            match at % 2 {
                0 => level.positive = 1,
                _ => level.negative = 1,
            }
        }
        // Of each pair in a bin one is true, as 0.5 says.
        assert_eq!(expected_error(&levels), Ok(0.0));
    }

    #[test]
    fn no_sample_has_no_calibration() {
        assert_eq!(expected_error(&[]), Err(Undefined::Empty));
    }
}
