//! Shares of samples in the training, validation and test parts.

use std::fmt;

use super::error::SplitError;
use taceva_core::whole_size;

/// Shares of samples in the training, validation and test parts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fractions {
    shares: [f64; 3],
}

impl Default for Fractions {
    /// Shares of 70 % training, 20 % validation and 10 % test.
    fn default() -> Fractions {
        Fractions {
            shares: [0.7, 0.2, 0.1],
        }
    }
}

impl Fractions {
    /// Shares proportional to `train`, `validation` and `test`, such as 70, 20 and 10. Each number is divided by their sum.
    ///
    /// # Errors
    /// [`SplitError::Fractions`] unless all shares are finite and nonnegative, and training has a share.
    pub fn new(train: f64, validation: f64, test: f64) -> Result<Fractions, SplitError> {
        let given = [train, validation, test];
        let sum: f64 = given.iter().sum();
        if train > 0.0 && given.iter().all(|share| *share >= 0.0) && sum.is_finite() {
            Ok(Fractions {
                shares: given.map(|share| share / sum),
            })
        } else {
            Err(SplitError::Fractions { given })
        }
    }

    /// Number of validation groups if `total` groups are divided between training and validation. Training keeps at least one group. Validation gets
    /// at least one if its share is positive and `total` exceeds 1.
    pub(super) fn validation_of_rest(&self, total: usize) -> usize {
        let [train, validation, _] = self.shares;
        let rest = Fractions {
            shares: [train, validation, 0.0].map(|share| share / (train + validation)),
        };
        let [_, wanted, _] = rest.counts(total);
        let least = usize::from(validation > 0.0 && total > 1);
        wanted.max(least).min(total.saturating_sub(1))
    }

    /// Shares of training, validation and test, in this order. Their sum is 1.
    pub fn shares(&self) -> [f64; 3] {
        self.shares
    }

    /// Number of items in each part if `total` items are divided by the largest-remainder method. Equal remainders favour the earlier part.
    pub(super) fn counts(&self, total: usize) -> [usize; 3] {
        let exact = self.shares.map(|share| share * total as f64);
        // 0.7 × 10 is 7.000…: a number that is an integer to within rounding counts as one.
        let whole = exact.map(|exact| (exact + 1e-9).floor());
        let mut counts = whole.map(whole_size);
        let mut order = [0, 1, 2];
        order.sort_by(|&a, &b| (exact[b] - whole[b]).total_cmp(&(exact[a] - whole[a])));
        let left = total.saturating_sub(counts.iter().sum());
        for part in order
            .into_iter()
            .filter(|&part| self.shares[part] > 0.0)
            .cycle()
            .take(left)
        {
            counts[part] += 1;
        }
        counts
    }
}

impl fmt::Display for Fractions {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [train, validation, test] = self.shares.map(|share| (share * 1e6).round() / 1e4);
        write!(f, "{train}/{validation}/{test}")
    }
}
