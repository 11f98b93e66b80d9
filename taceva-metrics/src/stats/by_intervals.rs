//! Comparison of two sensors on different samples, from their intervals.

use super::difference::{Difference, DifferenceTest, Inverse, Tested};
use super::error::ComparisonError;
use super::estimate::Estimate;
use super::parts::root_of_squares;
use super::sides::Sides;
use super::student::beyond;
use crate::score::value::UndefinedReason;

/// Least p value that is reported, 2⁻⁵³: for a smaller p, 1 − p rounds to 1.
pub(super) const LEAST_P: f64 = f64::EPSILON / 2.0;

/// Compares two scores of different samples, such as the scores of two sensors or of two sessions.
///
/// The interval of the difference follows from the intervals of both scores, each on its own scale and with its own degrees of freedom. Let l and u
/// be the distances from a score down and up to the ends of its interval. The ends for A − B are then (A − B) − √(l_A² + u_B²) and (A − B) + √(u_A² +
/// l_B²). The p value is the level at which an end of this interval is 0, so verdict, p value and interval agree. The least p value is 1.1e-16.
///
/// For two equal sensors, about 4 % of comparisons still show a difference, and more if few contact points cause most of the error.
/// `docs/coverage.md` describes the simulation, with Welch's test for comparison.
///
/// ```
/// use taceva_metrics::{Estimate, Sides, by_intervals};
/// let difference = by_intervals(Sides {
///     a: Estimate::try_new(0.041, 0.003, 32)?,
///     b: Estimate::try_new(0.053, 0.004, 32)?,
/// })?;
/// assert!((difference.value + 0.012).abs() < 1e-15 && (difference.standard_error - 0.005).abs() < 1e-15);
/// assert!(difference.p < 0.05);
/// # Ok::<(), taceva_metrics::ComparisonError>(())
/// ```
///
/// # Errors
/// [`ComparisonError::NoSpread`] if both standard errors are 0, [`ComparisonError::NoInterval`] if the interval is beyond the
/// range of binary64.
///
/// # Reference
/// Zou and Donner, Construction of confidence limits about effect measures: a general approach, Statistics in Medicine 27 (2008),
/// after Newcombe, Interval estimation for the difference between independent proportions, Statistics in Medicine 17 (1998).
pub fn by_intervals(estimates: Sides<Estimate>) -> Result<Difference, ComparisonError> {
    let Sides { a, b } = estimates;
    let [wide_a, wide_b] = [a, b].map(|estimate| estimate.distances(1.0));
    let is_still = |distances: [f64; 2]| distances.iter().all(|distance| *distance <= 0.0);
    if is_still(wide_a) && is_still(wide_b) {
        return Err(ComparisonError::NoSpread);
    }
    let pair = Pair { a, b };
    let value = a.value() - b.value();
    let standard_error = root_of_squares(a.standard_error(), b.standard_error());
    let [below, above] = pair.distances(0.05);
    let ends = [value - below, value + above];
    if !(standard_error.is_finite() && ends.iter().all(|end| end.is_finite())) {
        return Err(ComparisonError::NoInterval(UndefinedReason::Overflow));
    }
    let tested = Tested {
        value,
        scores: Sides {
            a: a.value(),
            b: b.value(),
        },
        standard_error,
        p: pair.p(0.0),
        test: DifferenceTest::Intervals {
            freedom: Sides {
                a: a.freedom(),
                b: b.freedom(),
            },
        },
    };
    Ok(tested.with(Inverse::Intervals(pair)))
}

/// Estimates A and B, which determine an interval of A − B at any level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pair {
    a: Estimate,
    b: Estimate,
}

impl Pair {
    /// Distances from A − B down and up to the ends of the interval at confidence 1 − `level`.
    pub(super) fn distances(&self, level: f64) -> [f64; 2] {
        let [below_a, above_a] = self.a.distances(beyond(level, self.a.freedom()));
        let [below_b, above_b] = self.b.distances(beyond(level, self.b.freedom()));
        [
            root_of_squares(below_a, above_b),
            root_of_squares(above_a, below_b),
        ]
    }

    /// Two-sided p value of the hypothesis A − B = `shift`: the level at which an end of the interval equals `shift`.
    pub(super) fn p(&self, shift: f64) -> f64 {
        /// Number of bisection steps, which find the level down to rounding.
        const HALVINGS: usize = 64;
        let apart = self.a.value() - self.b.value() - shift;
        let reaches = |level: f64| {
            let [below, above] = self.distances(level);
            if apart > 0.0 {
                below >= apart
            } else {
                above >= -apart
            }
        };
        if apart.is_nan() || apart.abs() <= 0.0 {
            return 1.0;
        }
        let (mut held, mut rejected) = (LEAST_P, 1.0_f64);
        if !reaches(held) {
            return LEAST_P;
        }
        for _ in 0..HALVINGS {
            let level = (held * rejected).sqrt();
            if reaches(level) {
                held = level;
            } else {
                rejected = level;
            }
        }
        rejected
    }
}
