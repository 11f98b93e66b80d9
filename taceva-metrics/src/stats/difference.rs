//! How far two scores are apart, and how sure that is.

use std::fmt;

use super::error::ComparisonError;
use super::sides::Sides;
use super::student::{quantile, two_sided, upper};
use crate::score::COVERAGE;
use crate::value::UndefinedReason;

/// The score of A less that of B.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Difference {
    /// A − B, in the unit of the scores.
    pub value: f64,
    /// Both scores.
    pub scores: Sides<f64>,
    /// How far the difference would move with other clusters.
    pub standard_error: f64,
    /// Degrees of freedom of the standard error.
    pub freedom: f64,
    /// The 95 % interval: value ± t(freedom) × standard error.
    pub interval: [f64; 2],
    /// How often a difference as large as this would be seen if there were none; to both sides.
    pub p: f64,
    /// Which test gave `p`.
    pub test: DifferenceTest,
}

/// A test of whether two scores differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum DifferenceTest {
    /// On the same samples: the signs of the clusters' differences are exchanged.
    SignFlip {
        /// Clusters that were paired.
        clusters: usize,
        /// Patterns of signs that were tried.
        flips: u32,
        /// Whether these are all there are.
        exhaustive: bool,
    },
    /// On different samples: Welch's, by the standard errors of both.
    Welch,
}

/// What a difference and its standard error are known from, before it is tested.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spread {
    pub(super) value: f64,
    pub(super) scores: Sides<f64>,
    pub(super) standard_error: f64,
    pub(super) freedom: f64,
}

impl Spread {
    /// The p value of t = value / standard error; 1 if both are 0.
    pub(super) fn p(&self) -> f64 {
        if self.value.abs() > 0.0 {
            two_sided(self.value / self.standard_error, self.freedom)
        } else {
            1.0
        }
    }

    pub(super) fn tested(
        self,
        test: DifferenceTest,
        p: f64,
    ) -> Result<Difference, ComparisonError> {
        let half = quantile(COVERAGE, self.freedom) * self.standard_error;
        let interval = [self.value - half, self.value + half];
        if !interval.iter().all(|end| end.is_finite()) {
            return Err(ComparisonError::NoInterval(UndefinedReason::Overflow));
        }
        Ok(Difference {
            value: self.value,
            scores: self.scores,
            standard_error: self.standard_error,
            freedom: self.freedom,
            interval,
            p,
            test,
        })
    }
}

impl Difference {
    /// The same difference with the p value that [`holm`](crate::holm) made of its own and those of its family.
    #[must_use]
    pub fn with_adjusted_p(self, p: f64) -> Difference {
        Difference { p, ..self }
    }

    /// How often scores that are at least `margin` apart would look as near to each other as these: the larger p value of
    /// two one-sided tests.
    ///
    /// # Units
    /// `margin` is in the unit of the scores.
    ///
    /// # Errors
    /// [`ComparisonError::Margin`] if it is not above 0 and finite.
    ///
    /// # Reference
    /// Schuirmann, A comparison of the two one-sided tests procedure and the power approach, Journal of Pharmacokinetics and
    /// Biopharmaceutics 15 (1987).
    pub fn equivalence_p(&self, margin: f64) -> Result<f64, ComparisonError> {
        if !(margin > 0.0 && margin.is_finite()) {
            return Err(ComparisonError::Margin(margin));
        }
        let inside = margin - self.value.abs();
        // Of the two tests that of the nearer bound has the larger p. On the bound t is 0, whatever the standard error.
        let t = if inside.abs() > 0.0 {
            inside / self.standard_error
        } else {
            0.0
        };
        Ok(upper(t, self.freedom))
    }
}

impl fmt::Display for DifferenceTest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            DifferenceTest::SignFlip {
                clusters,
                flips,
                exhaustive,
            } => {
                let how = if *exhaustive { "all " } else { "" };
                write!(
                    f,
                    "paired sign flip by cluster, G={clusters}, {how}{flips} flips"
                )
            }
            DifferenceTest::Welch => f.write_str("Welch by standard errors of clusters"),
        }
    }
}
