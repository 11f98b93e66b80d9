//! Sums over the means and differences of pairs, added in blocks.

use crate::exact::moments::Moments;
use crate::exact::{ColumnAdder, ColumnSums, ExactSum};
use crate::stats::DifferenceLine;

/// Pairs of columns to multiply: mean², mean · difference, difference².
const PRODUCTS: [[usize; 2]; 3] = [[0, 0], [0, 1], [1, 1]];

/// Mean and difference of truth and prediction, for the pairs of a batch.
pub(super) struct PairColumns {
    adder: ColumnAdder,
    means: Vec<f64>,
    differences: Vec<f64>,
}

impl Default for PairColumns {
    fn default() -> PairColumns {
        PairColumns {
            adder: ColumnAdder::new(PRODUCTS.to_vec()),
            means: Vec::new(),
            differences: Vec::new(),
        }
    }
}

impl PairColumns {
    /// Appends the mean and the difference of a pair.
    pub(super) fn push(&mut self, mean: f64, difference: f64) {
        self.means.push(mean);
        self.differences.push(difference);
    }

    /// Adds the pairs to the sums of `line`, clears them, and returns the moments of their differences.
    pub(super) fn settle_into(&mut self, line: &mut DifferenceLine) -> Moments {
        let mut sums = PairSums::default();
        self.adder.add(&[&self.means, &self.differences], &mut sums);
        let n = self.means.len() as u64;
        self.means.clear();
        self.differences.clear();
        let [of_means, sum] = &sums.columns;
        let [of_squares, shared, squares] = &sums.products;
        for (own, other) in line.sums.iter_mut().zip([of_means, of_squares, shared]) {
            own.merge(other);
        }
        Moments {
            n,
            sum: sum.clone(),
            squares: squares.clone(),
        }
    }
}

#[derive(Default)]
struct PairSums {
    columns: [ExactSum; 2],
    products: [ExactSum; 3],
}

impl ColumnSums for PairSums {
    fn sums(&mut self) -> [&mut [ExactSum]; 2] {
        [&mut self.columns, &mut self.products]
    }

    // `PairColumns` counts its pairs, and all of them are valid.
    fn take(&mut self, _columns: &[&[f64]]) {}

    fn leave_out(&mut self) {}
}
