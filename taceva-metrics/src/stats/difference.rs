//! Difference of two scores, and its uncertainty.

use std::fmt;

use super::by_intervals::Pair;
use super::error::ComparisonError;
use super::holm::{LEVEL, Step, steps};
use super::sides::Sides;
use super::student::{beyond, upper};

/// Difference A − B of two scores, with test and interval.
///
/// Verdict, p value and interval follow from one decision. [`decide`] decides several differences together, as a family of tests. Before that call,
/// each difference is decided alone.
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
    /// Scores A and B.
    pub scores: Sides<f64>,
    /// Standard error of the difference, from the variation between clusters. If several trainings are given, their variation is added.
    pub standard_error: f64,
    /// Interval of the difference at this `confidence`. The interval excludes 0 exactly if a difference is shown. An end is infinite if the clusters
    /// are too few to reject any difference on that side.
    pub interval: [f64; 2],
    /// Confidence of the interval: 0.95 for a difference that is decided alone, at least 0.95 in a family.
    pub confidence: f64,
    /// Two-sided p value of this test alone: the probability of a difference at least this large if the true scores are equal.
    pub p: f64,
    /// p value adjusted for all tests of the family by [`holm`](crate::holm).
    pub adjusted_p: f64,
    /// True if a difference is shown: the adjusted p value is at most 0.05.
    pub is_shown: bool,
    /// Test that gave `p` and the interval.
    pub test: DifferenceTest,
    /// Data from which the confidence interval is computed at another level.
    inverse: Inverse,
}

/// Data from which the confidence interval is computed at another level.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Inverse {
    /// Estimates of both scores, whose intervals are known at any level.
    Intervals(Pair),
    /// Ranges of differences, one for each pattern of signs of a sign-flip test.
    Flips(Flips),
    /// Student's distribution with `freedom` degrees of freedom, scaled by the standard error of the difference.
    Student { freedom: f64 },
}

/// Lower ends (ascending) and upper ends (descending) of ranges, one for each pattern of signs. If the assumed difference is in this range, the sum
/// with the pattern's signs has at least the magnitude of the observed sum. An unlimited range has infinite ends.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Flips {
    pub(super) from_below: Vec<f64>,
    pub(super) from_above: Vec<f64>,
    /// Degrees of freedom of the standard error.
    pub(super) freedom: f64,
}

impl Flips {
    /// Interval of the differences with a p value above `level`.
    fn interval(&self, level: f64) -> [f64; 2] {
        // p(δ) is the share of patterns that count, so more than level × N of N patterns must count.
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

/// Decides a family of differences, and computes the interval of each difference at the level of its decision. If all scores are truly equal, at most
/// one family in twenty shows a difference.
///
/// Holm's procedure decides the i-th smallest of m p values at 0.05 / (m − i + 1). After the first test that shows no difference, all tests use the
/// level of that test.
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
    // Every p value is a share or a tail, so there is a step for each.
    let steps = steps(&p_values, LEVEL).unwrap_or_default();
    for (difference, step) in family.iter_mut().zip(steps) {
        difference.take(step);
    }
}

/// Test for a difference of two scores.
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
    /// Sign-flip test on the same samples: inverts the signs of the clusters' differences.
    SignFlip {
        /// Number of paired clusters.
        clusters: usize,
        /// Number of patterns of signs that were tried.
        flips: u32,
        /// True if all possible patterns of signs were tried.
        exhaustive: bool,
    },
    /// Test of scores on different samples, by the intervals of both scores.
    Intervals {
        /// Degrees of freedom of both intervals.
        freedom: Sides<f64>,
    },
    /// Student's t test on the same samples, with the variance between trainings of the models.
    PairedTrainings {
        /// Number of paired clusters.
        clusters: usize,
        /// Degrees of freedom of the difference.
        freedom: f64,
    },
}

/// A tested difference before its interval is computed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tested {
    pub(super) value: f64,
    pub(super) scores: Sides<f64>,
    pub(super) standard_error: f64,
    pub(super) p: f64,
    pub(super) test: DifferenceTest,
}

impl Tested {
    /// Computes the interval of a difference that is decided alone, outside of a family.
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
    /// Sets adjusted p value, confidence and interval by the decision `step`.
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
            Inverse::Student { freedom } => {
                let half = beyond(step.level, *freedom) * self.standard_error;
                [self.value - half, self.value + half]
            }
        };
        let (low, high) = (low.min(self.value), high.max(self.value));
        // If p equals the level the end is 0, up to rounding.
        self.interval = match (self.is_shown, self.value > 0.0) {
            (true, true) => [low.max(0.0), high],
            (true, false) => [low, high.min(0.0)],
            (false, _) => [low.min(0.0), high.max(0.0)],
        };
    }

    /// True if the scores are shown to differ by less than `margin`: the whole interval is within the margin.
    ///
    /// # Units
    /// `margin` is in the unit of the scores.
    ///
    /// # Errors
    /// [`ComparisonError::Margin`] if `margin` is not above 0 and finite.
    pub fn is_within(&self, margin: f64) -> Result<bool, ComparisonError> {
        if !(margin > 0.0 && margin.is_finite()) {
            return Err(ComparisonError::Margin(margin));
        }
        Ok(self.interval.iter().all(|end| end.abs() < margin))
    }

    /// p value of equivalence: the larger p value of the two one-sided tests against a difference of at least `margin`.
    ///
    /// # Units
    /// `margin` is in the unit of the scores.
    ///
    /// # Errors
    /// [`ComparisonError::Margin`] if `margin` is not above 0 and finite.
    ///
    /// # Reference
    /// Schuirmann, A comparison of the two one-sided tests procedure and the power approach, Journal of Pharmacokinetics and
    /// Biopharmaceutics 15 (1987).
    pub fn equivalence_p(&self, margin: f64) -> Result<f64, ComparisonError> {
        if !(margin > 0.0 && margin.is_finite()) {
            return Err(ComparisonError::Margin(margin));
        }
        // The test of the nearer bound has the larger p. On the bound p is 0.5, for any standard error.
        let inside = margin - self.value.abs();
        if inside.abs() <= 0.0 {
            return Ok(0.5);
        }
        Ok(match &self.inverse {
            Inverse::Flips(flips) => upper(inside / self.standard_error, flips.freedom),
            Inverse::Student { freedom } => upper(inside / self.standard_error, *freedom),
            Inverse::Intervals(pair) => {
                let beyond = pair.p(margin.copysign(self.value)) / 2.0;
                if inside > 0.0 { beyond } else { 1.0 - beyond }
            }
        })
    }
}

impl DifferenceTest {
    /// Least p value that this test can give. A sign-flip test of few clusters has few patterns of signs, so its least p value is large.
    ///
    /// ```
    /// use taceva_metrics::DifferenceTest;
    /// let test = DifferenceTest::SignFlip { clusters: 5, flips: 32, exhaustive: true };
    /// assert_eq!(test.least_p(), 0.0625);
    /// ```
    pub fn least_p(self) -> f64 {
        match self {
            DifferenceTest::SignFlip {
                flips,
                exhaustive: true,
                ..
            } => 2.0 / f64::from(flips),
            DifferenceTest::SignFlip { flips, .. } => 1.0 / (f64::from(flips) + 1.0),
            _ => 0.0,
        }
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
            DifferenceTest::PairedTrainings { clusters, .. } => write!(
                f,
                "paired t by cluster with the variance between trainings, G={clusters}"
            ),
        }
    }
}
