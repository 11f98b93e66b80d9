//! Exact sums of the losses of probabilities.

use serde::{Deserialize, Serialize};
use taceva_metrics::elementary::logarithm;
use taceva_metrics::{Dyadic, ExactSum};

use crate::error::TaskError;
use crate::quotient::{Quotient, ratio, sum_over};
use crate::undefined::Undefined;

/// Sums of the losses of some samples.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Losses {
    /// Number of samples with probabilities.
    n: u64,
    /// Number of samples whose numbers are not probabilities.
    others: u64,
    /// Number of samples whose class has probability 0.
    impossible: u64,
    squares: ExactSum,
    logarithms: ExactSum,
    /// Number of samples of each class, by position.
    classes: Vec<u64>,
}

impl Losses {
    /// Adds a sample of the class `truth` with the probabilities `row`. `of_two` is the position of the positive class if there are two classes.
    pub(super) fn add(&mut self, of_two: Option<usize>, truth: usize, row: &[f64]) {
        self.n += 1;
        self.classes.resize(row.len(), 0);
        self.classes[truth] += 1;
        match of_two {
            Some(positive) => self.add_square(row[positive], truth == positive),
            None => {
                for (class, p) in row.iter().enumerate() {
                    self.add_square(*p, class == truth);
                }
            }
        }
        match row[truth] > 0.0 {
            true => self.logarithms.add(-logarithm(row[truth])),
            false => self.impossible += 1,
        }
    }

    /// Adds the squared difference of the probability `p` from 1 if `is_true`, otherwise from 0, exactly.
    fn add_square(&mut self, p: f64, is_true: bool) {
        self.squares.add_product(p, p);
        if is_true {
            self.squares.add_product(-2.0, p);
            self.squares.add(1.0);
        }
    }

    /// Adds a sample whose numbers are not probabilities.
    pub(super) fn add_other(&mut self) {
        self.others += 1;
    }

    /// Adds all samples of `other`.
    pub(super) fn merge(&mut self, other: &Losses) {
        self.n += other.n;
        self.others += other.others;
        self.impossible += other.impossible;
        self.squares.merge(&other.squares);
        self.logarithms.merge(&other.logarithms);
        let longer = self.classes.len().max(other.classes.len());
        self.classes.resize(longer, 0);
        for (count, other) in self.classes.iter_mut().zip(&other.classes) {
            *count += other;
        }
    }

    /// The losses without those of `part`. These losses must include `part`.
    pub(super) fn without(&self, part: &Losses) -> Losses {
        let mut left = self.clone();
        left.n -= part.n;
        left.others -= part.others;
        left.impossible -= part.impossible;
        left.squares.subtract(&part.squares);
        left.logarithms.subtract(&part.logarithms);
        for (count, part) in left.classes.iter_mut().zip(&part.classes) {
            *count -= part;
        }
        left
    }

    /// Refuses counts of a file that contradict each other or the number of classes.
    pub(super) fn check(&self, classes: usize) -> Result<(), TaskError> {
        let mut n = 0;
        for count in &self.classes {
            n = TaskError::checked_count(n, *count)?;
        }
        TaskError::checked_count(n, self.others)?;
        match n == self.n && self.impossible <= n && [0, classes].contains(&self.classes.len()) {
            true => Ok(()),
            false => Err(TaskError::damaged(format!(
                "{} samples with probabilities, {n} of {} classes",
                self.n,
                self.classes.len()
            ))),
        }
    }

    /// Number of samples.
    pub(super) fn n(&self) -> u64 {
        self.n + self.others
    }

    /// Brier score: mean squared difference of probability and outcome, 1 or 0.
    pub(super) fn brier(&self) -> Result<f64, Undefined> {
        self.mean(&self.squares)
    }

    /// Mean of −ln of the probability of the true class.
    pub(super) fn log_loss(&self) -> Result<f64, Undefined> {
        match self.impossible {
            0 => self.mean(&self.logarithms),
            _ => self.brier().and(Err(Undefined::InfiniteLoss)),
        }
    }

    fn mean(&self, sum: &ExactSum) -> Result<f64, Undefined> {
        match (self.others, self.n) {
            (0, 0) => Err(Undefined::Empty),
            (0, n) => Ok(sum.to_dyadic().over(&Dyadic::from(n))),
            _ => Err(Undefined::NotProbabilities),
        }
    }

    /// Brier score with the class shares π as probabilities: π (1 − π), summed over the classes if there are more than two; `None` for no sample.
    pub(super) fn brier_of_shares(&self, of_two: Option<usize>) -> Option<f64> {
        let square = |count: &u64| Quotient {
            above: u128::from(*count) * u128::from(self.n - count),
            below: self.n,
        };
        match (self.n, of_two) {
            (0, _) => None,
            (n, None) => Some(sum_over(self.classes.iter().map(square), n)),
            (n, Some(positive)) => {
                let count = self.classes.get(positive)?;
                Some(sum_over(std::iter::once(square(count)), n))
            }
        }
    }

    /// Mean logarithmic loss with the class shares π as probabilities: −Σ π ln π; `None` for no sample.
    pub(super) fn log_loss_of_shares(&self) -> Option<f64> {
        let seen = self.classes.iter().filter(|count| **count > 0);
        let terms = seen.map(|count| {
            let share = ratio(u128::from(*count), u128::from(self.n));
            -share * logarithm(share)
        });
        (self.n > 0).then(|| terms.collect::<ExactSum>().to_f64())
    }
}
