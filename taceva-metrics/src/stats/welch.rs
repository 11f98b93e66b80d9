//! Two sensors, each on its own samples: Welch's test.

use super::difference::{Difference, DifferenceTest, Inverse, Spread};
use super::error::ComparisonError;
use super::least::LEAST_CLUSTERS;
use super::sides::{Side, Sides};
use crate::score::value::{InapplicableReason, UndefinedReason, Value};
use crate::score::{Interval, Score};

/// A score, how far it would move with other clusters, and how many there were to tell.
///
/// ```
/// use taceva_metrics::Estimate;
/// assert!(Estimate::try_new(0.041, 0.003, 32).is_ok());
/// assert!(Estimate::try_new(0.041, 0.003, 4).is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    value: f64,
    standard_error: f64,
    clusters: usize,
}

impl Estimate {
    /// A value with the standard error that `clusters` give it.
    ///
    /// # Errors
    /// [`ComparisonError::Score`] or [`ComparisonError::StandardError`] if one is not finite or the error is below 0,
    /// [`ComparisonError::TooFewClusters`] if there are fewer than five.
    pub fn try_new(
        value: f64,
        standard_error: f64,
        clusters: usize,
    ) -> Result<Estimate, ComparisonError> {
        if !value.is_finite() {
            return Err(ComparisonError::Score(value));
        }
        if !(standard_error.is_finite() && standard_error >= 0.0) {
            return Err(ComparisonError::StandardError(standard_error));
        }
        if clusters < LEAST_CLUSTERS {
            return Err(ComparisonError::TooFewClusters { have: clusters });
        }
        Ok(Estimate {
            value,
            standard_error,
            clusters,
        })
    }

    /// Two scores of one meaning.
    ///
    /// # Errors
    /// [`ComparisonError::Meaning`] if definition, unit or constants differ, [`ComparisonError::Undefined`] or
    /// [`ComparisonError::NotApplicable`] if one has no value or no interval.
    pub fn try_from_scores(scores: Sides<&Score>) -> Result<Sides<Estimate>, ComparisonError> {
        let (a, b) = (meaning(scores.a), meaning(scores.b));
        if a != b {
            return Err(ComparisonError::Meaning(Sides { a, b }));
        }
        scores.try_map(Estimate::of_side)
    }

    fn of_side(side: Side, score: &Score) -> Result<Estimate, ComparisonError> {
        let value = match score.value {
            Value::Scalar(value) => value,
            Value::Undefined(reason) => return Err(ComparisonError::Undefined { side, reason }),
            Value::NotApplicable(reason) => {
                return Err(ComparisonError::NotApplicable { side, reason });
            }
            Value::Map(_) | Value::Curve(_) | Value::Matrix(_) => {
                let reason = InapplicableReason::NotOneNumber;
                return Err(ComparisonError::NotApplicable { side, reason });
            }
        };
        let (standard_error, clusters) = match score.interval {
            Interval::Jackknife {
                standard_error,
                clusters,
                ..
            }
            | Interval::Bootstrap {
                standard_error,
                clusters,
                ..
            }
            | Interval::Delta {
                standard_error,
                clusters,
                ..
            } => (standard_error, clusters),
            // Samples taken as independent would make any two sensors differ.
            Interval::Wilson { .. } => {
                let reason = UndefinedReason::NoClusters;
                return Err(ComparisonError::Undefined { side, reason });
            }
            Interval::Undefined(reason) => {
                return Err(ComparisonError::Undefined { side, reason });
            }
        };
        Estimate::try_new(value, standard_error, clusters)
    }

    fn freedom(&self) -> f64 {
        let below = u32::try_from(self.clusters - 1).unwrap_or(u32::MAX);
        f64::from(below)
    }
}

/// What a score is of, in words: `mae/1 in N`, with its constants.
fn meaning(score: &Score) -> String {
    let constants = score.parameters.iter();
    let constants = constants.map(|constant| format!(", {} = {}", constant.name, constant.value));
    let start = format!("{} in {}", score.definition, score.unit);
    constants.fold(start, |all, constant| all + &constant)
}

/// Whether two scores differ that come of different samples: of two sensors, or of two sessions.
///
/// With standard errors s_A and s_B, of ν_A = G_A − 1 and ν_B = G_B − 1 degrees of freedom, t is
/// (A − B) / √(s_A² + s_B²) with ν = (s_A² + s_B²)² / (s_A⁴ / ν_A + s_B⁴ / ν_B) degrees of freedom.
///
/// ```
/// use taceva_metrics::{Estimate, Sides, welch};
/// let difference = welch(Sides {
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
/// Welch, The generalization of "Student's" problem when several different population variances are involved, Biometrika 34
/// (1947); Satterthwaite, An approximate distribution of estimates of variance components, Biometrics Bulletin 2 (1946).
pub fn welch(estimates: Sides<Estimate>) -> Result<Difference, ComparisonError> {
    let Sides { a, b } = estimates;
    let larger = a.standard_error.max(b.standard_error);
    if larger <= 0.0 {
        return Err(ComparisonError::NoSpread);
    }
    // As shares of the larger error, so that no square leaves the range.
    let variance = |estimate: &Estimate| (estimate.standard_error / larger).powi(2);
    let (variance_a, variance_b) = (variance(&a), variance(&b));
    let both = variance_a + variance_b;
    let fourth_powers =
        variance_a * variance_a / a.freedom() + variance_b * variance_b / b.freedom();
    let spread = Spread {
        value: a.value - b.value,
        scores: Sides {
            a: a.value,
            b: b.value,
        },
        standard_error: larger * both.sqrt(),
        freedom: both * both / fourth_powers,
    };
    spread.tested(DifferenceTest::Welch, spread.p(), Inverse::Student)
}
