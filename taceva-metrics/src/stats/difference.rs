//! How far two scores are apart, and how certain that is.

use std::fmt;

use super::by_intervals::Pair;
use super::error::ComparisonError;
use super::holm::{LEVEL, Step, steps};
use super::sides::Sides;
use super::student::upper;

/// The score of A less that of B.
///
/// Verdict, p value and interval rest on one decision: [`decide`] makes it for a family of differences at once, and until then a difference
/// is a family of its own.
///
/// ```
/// use taceva_metrics::{Estimate, Sides, by_intervals};
/// let (a, b) = (Estimate::try_new(0.041, 0.003, 32)?, Estimate::try_new(0.053, 0.004, 32)?);
/// let difference = by_intervals(Sides { a, b })?;
/// assert!(difference.is_shown && difference.interval[1] < 0.0);
/// # Ok::<(), taceva_metrics::ComparisonError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Difference {
    /// A − B, in the unit of the scores.
    pub value: f64,
    /// Both scores.
    pub scores: Sides<f64>,
    /// How far the difference would move with other clusters.
    pub standard_error: f64,
    /// The differences that the test at `1 − confidence` does not reject: 0 is none of them exactly where a difference is shown. An end is
    /// infinite where so few clusters reject none on that side.
    pub interval: [f64; 2],
    /// What the interval is of: 0.95 of one difference alone, more of one in a family.
    pub confidence: f64,
    /// How often a difference as large as this would be seen if there were none; to both sides, and of this test alone.
    pub p: f64,
    /// The p value adjusted for the family by [`holm`](crate::holm).
    pub adjusted_p: f64,
    /// Whether a difference is shown: whether the adjusted p value is at most 0.05.
    pub is_shown: bool,
    /// Which test gave `p` and the interval.
    pub test: DifferenceTest,
    /// What the test says of other differences than none.
    inverse: Inverse,
}

/// What a test says of any difference.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Inverse {
    /// The intervals of both scores, at any level.
    Intervals(Pair),
    /// The differences from which on each pattern of signs counts, to either side.
    Flips(Flips),
}

/// From below and from above, in their order: the differences from which on another pattern of signs gives as large a sum as the one that was
/// seen. Patterns that always do stand as infinite.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Flips {
    pub(super) from_below: Vec<f64>,
    pub(super) from_above: Vec<f64>,
    /// Degrees of freedom of the standard error.
    pub(super) freedom: f64,
}

impl Flips {
    /// The differences whose p value is above `level`.
    fn interval(&self, level: f64) -> [f64; 2] {
        // p(δ) is the share of patterns that count; of N patterns more than level × N must.
        let patterns = self.from_below.iter().fold(0.0, |count, _| count + 1.0);
        let mut skipped = 0.0;
        let mut at = 0;
        while skipped + 1.0 <= level * patterns {
            skipped += 1.0;
            at += 1;
        }
        [self.from_below[at], self.from_above[at]]
    }
}

/// Decides about a family of differences, and gives each the interval of its own step: where none of the scores differ, a difference is
/// shown in at most one family in twenty.
///
/// By Holm's procedure the i-th smallest of m p values is decided at 0.05 / (m − i + 1), and all from the first that is kept at the level of that one.
///
/// ```
/// use taceva_metrics::{Estimate, Sides, by_intervals, decide};
/// let apart = |b| {
///     let a = Estimate::try_new(0.041, 0.003, 32)?;
///     by_intervals(Sides { a, b: Estimate::try_new(b, 0.004, 32)? })
/// };
/// let mut family = [apart(0.053)?, apart(0.041)?];
/// decide(&mut family);
/// let [near, same] = family;
/// assert_eq!(near.adjusted_p, 2.0 * near.p);
/// assert!(near.is_shown && near.interval[1] < 0.0 && near.confidence == 0.975);
/// assert!(!same.is_shown && same.interval[0] < 0.0 && same.confidence == 0.95);
/// # Ok::<(), taceva_metrics::ComparisonError>(())
/// ```
///
/// # Reference
/// Holm, A simple sequentially rejective multiple test procedure, Scandinavian Journal of Statistics 6 (1979).
pub fn decide(family: &mut [Difference]) {
    let p_values: Vec<f64> = family.iter().map(|difference| difference.p).collect();
    // Every p value is a share or a tail, so that there is a step for each.
    let steps = steps(&p_values, LEVEL).unwrap_or_default();
    for (difference, step) in family.iter_mut().zip(steps) {
        difference.take(step);
    }
}

/// A test of whether two scores differ.
///
/// ```
/// use taceva_metrics::{DifferenceTest, Estimate, Sides, by_intervals};
/// let same = Estimate::try_new(0.041, 0.003, 32)?;
/// let freedom = Sides { a: 31.0, b: 31.0 };
/// assert_eq!(by_intervals(Sides { a: same, b: same })?.test, DifferenceTest::Intervals { freedom });
/// # Ok::<(), taceva_metrics::ComparisonError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
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
    /// On different samples: by the intervals of both.
    Intervals {
        /// Degrees of freedom of the interval of each.
        freedom: Sides<f64>,
    },
}

/// A difference and the test of it, before it has an interval.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tested {
    pub(super) value: f64,
    pub(super) scores: Sides<f64>,
    pub(super) standard_error: f64,
    pub(super) p: f64,
    pub(super) test: DifferenceTest,
}

impl Tested {
    /// The difference, as a family of its own.
    pub(super) fn with(self, inverse: Inverse) -> Difference {
        let Tested { p, .. } = self;
        let step = Step {
            adjusted_p: p,
            is_rejected: p <= LEVEL,
            level: LEVEL,
        };
        let mut difference = Difference {
            value: self.value,
            scores: self.scores,
            standard_error: self.standard_error,
            interval: [self.value; 2],
            confidence: 1.0 - LEVEL,
            p,
            adjusted_p: p,
            is_shown: step.is_rejected,
            test: self.test,
            inverse,
        };
        difference.take(step);
        difference
    }
}

impl Difference {
    /// Takes over what the family decides.
    fn take(&mut self, step: Step) {
        self.adjusted_p = step.adjusted_p;
        self.is_shown = step.is_rejected;
        self.confidence = 1.0 - step.level;
        let [low, high] = match &self.inverse {
            Inverse::Intervals(pair) => {
                let [below, above] = pair.distances(step.level);
                [self.value - below, self.value + above]
            }
            Inverse::Flips(flips) => flips.interval(step.level),
        };
        let (low, high) = (low.min(self.value), high.max(self.value));
        // Where p is the level itself the end is 0, but for rounding.
        self.interval = match (self.is_shown, self.value > 0.0) {
            (true, true) => [low.max(0.0), high],
            (true, false) => [low, high.min(0.0)],
            (false, _) => [low.min(0.0), high.max(0.0)],
        };
    }

    /// Whether the scores are shown to be less than `margin` apart: whether the interval lies within it.
    ///
    /// # Units
    /// `margin` is in the unit of the scores.
    ///
    /// # Errors
    /// [`ComparisonError::Margin`] if it is not above 0 and finite.
    pub fn is_within(&self, margin: f64) -> Result<bool, ComparisonError> {
        if !(margin > 0.0 && margin.is_finite()) {
            return Err(ComparisonError::Margin(margin));
        }
        Ok(self.interval.iter().all(|end| end.abs() < margin))
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
        // Of the two tests that of the nearer bound has the larger p. On the bound it is a half, whatever the standard error.
        let inside = margin - self.value.abs();
        if inside.abs() <= 0.0 {
            return Ok(0.5);
        }
        Ok(match &self.inverse {
            Inverse::Flips(flips) => upper(inside / self.standard_error, flips.freedom),
            Inverse::Intervals(pair) => {
                let beyond = pair.p(margin.copysign(self.value)) / 2.0;
                if inside > 0.0 { beyond } else { 1.0 - beyond }
            }
        })
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
            DifferenceTest::Intervals { .. } => f.write_str("by the intervals of both"),
        }
    }
}
