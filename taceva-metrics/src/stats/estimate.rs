//! A score with its interval at any level of confidence.

mod over_trainings;

use super::error::ComparisonError;
use super::sides::{Side, Sides};
use super::student::quantile;
use crate::elementary::{exponential, logarithm};
use crate::score::least::LEAST_CLUSTERS;
use crate::score::value::{InapplicableReason, UndefinedReason, Value};
use crate::score::{COVERAGE, Interval, Scale, Score};

/// A score, its standard error with degrees of freedom, and the scale of its interval.
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
    freedom: f64,
    shape: Shape,
}

/// Scale of an interval, with a step down and a step up on this scale. An end is t steps from the score, with Student's t.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Shape {
    /// Scale of the score itself.
    Own([f64; 2]),
    /// Logarithm of the distance from `end`.
    Logarithm { end: f64, steps: [f64; 2] },
    /// Logarithm of the odds of value / `width`.
    Odds { width: f64, steps: [f64; 2] },
    /// Wilson's interval of a share of `samples` samples.
    Share { samples: f64 },
}

/// 95 % interval with given ends, for an [`Estimate`] without a [`Score`].
///
/// ```
/// use taceva_metrics::{Estimate, Scale, StatedInterval};
/// let stated = StatedInterval::new([0.030, 0.056], 31.0, 32).on(Scale::Logarithm);
/// assert!(Estimate::try_from_interval(0.041, stated).is_ok());
/// assert!(Estimate::try_from_interval(0.029, stated).is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct StatedInterval {
    /// Lower and upper end, in the unit of the score.
    pub ends: [f64; 2],
    /// Degrees of freedom of Student's t.
    pub freedom: f64,
    /// Number of clusters.
    pub clusters: usize,
    /// Scale on which the ends are symmetric about the value.
    pub scale: Scale,
    /// Standard error, in the unit of the score. `None` stands for half the width of the interval, divided by Student's t.
    pub standard_error: Option<f64>,
}

impl StatedInterval {
    /// Interval on the scale of the score itself.
    pub const fn new(ends: [f64; 2], freedom: f64, clusters: usize) -> StatedInterval {
        StatedInterval {
            ends,
            freedom,
            clusters,
            scale: Scale::Own,
            standard_error: None,
        }
    }

    /// The same interval on another [`scale`](StatedInterval::scale).
    #[must_use]
    pub const fn on(self, scale: Scale) -> StatedInterval {
        StatedInterval { scale, ..self }
    }

    /// The same interval with its [`standard_error`](StatedInterval::standard_error).
    #[must_use]
    pub fn with_standard_error(self, standard_error: impl Into<Option<f64>>) -> StatedInterval {
        StatedInterval {
            standard_error: standard_error.into(),
            ..self
        }
    }
}

impl Estimate {
    /// Estimate from a value and the standard error over `clusters` clusters, symmetric on the scale of the score. The degrees of freedom are
    /// the number of clusters minus one.
    ///
    /// # Errors
    /// [`ComparisonError::Score`] or [`ComparisonError::StandardError`] if a number is not finite or the standard error is negative,
    /// [`ComparisonError::TooFewClusters`] for fewer than five clusters.
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
            freedom: freedom_of(clusters),
            shape: Shape::Own([standard_error; 2]),
        })
    }

    /// Estimate from a value and its 95 % interval.
    ///
    /// # Errors
    /// The errors of [`try_new`](Estimate::try_new). Also [`ComparisonError::Freedom`] if the degrees of freedom are not finite or below 1, and
    /// [`ComparisonError::Ends`] if the interval does not contain the value.
    pub fn try_from_interval(
        value: f64,
        stated: StatedInterval,
    ) -> Result<Estimate, ComparisonError> {
        let StatedInterval {
            ends: [low, high],
            freedom,
            ..
        } = stated;
        if !(low.is_finite() && high.is_finite() && low <= value && value <= high) {
            return Err(ComparisonError::Ends {
                value,
                ends: stated.ends,
            });
        }
        if !(freedom.is_finite() && freedom >= 1.0) {
            return Err(ComparisonError::Freedom(freedom));
        }
        let t = quantile(COVERAGE, freedom);
        let half = (high - low) / 2.0 / t;
        let standard_error = stated.standard_error.unwrap_or(half);
        let estimate = Estimate::try_new(value, standard_error, stated.clusters)?;
        let own = [value - low, high - value].map(|distance| distance / t);
        let shape = match stated.scale {
            Scale::Own => Shape::Own(own),
            // A cut end does not show the variation of the score.
            Scale::Cut => Shape::Own([standard_error; 2]),
            Scale::Logarithm => logarithmic(value, [low, high], t).unwrap_or(Shape::Own(own)),
            Scale::Logit => odds(value, [low, high], t).unwrap_or(Shape::Own(own)),
            Scale::Wilson => share(value, [low, high], t).unwrap_or(Shape::Own(own)),
        };
        Ok(Estimate {
            freedom,
            shape,
            ..estimate
        })
    }

    /// Estimates from two scores with the same definition, unit and constants.
    ///
    /// # Errors
    /// [`ComparisonError::Meaning`] if definition, unit or constants differ, [`ComparisonError::Undefined`] or
    /// [`ComparisonError::NotApplicable`] if a score has no value or no interval.
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
        match (stated(&score.interval), score.interval) {
            (Some(stated), _) => Estimate::try_from_interval(value, stated),
            (None, Interval::Undefined(reason)) => Err(ComparisonError::Undefined { side, reason }),
            // With samples taken as independent, any two sensors would differ.
            (None, _) => {
                let reason = UndefinedReason::NoClusters;
                Err(ComparisonError::Undefined { side, reason })
            }
        }
    }

    /// Ends of the 95 % interval.
    ///
    /// ```
    /// use taceva_metrics::{Estimate, StatedInterval};
    /// let estimate = Estimate::try_from_interval(0.5, StatedInterval::new([0.25, 0.75], 31.0, 32))?;
    /// let [low, high] = estimate.ends();
    /// assert!((low - 0.25).abs() < 1e-12 && (high - 0.75).abs() < 1e-12);
    /// # Ok::<(), taceva_metrics::ComparisonError>(())
    /// ```
    pub fn ends(&self) -> [f64; 2] {
        let [below, above] = self.distances(quantile(COVERAGE, self.freedom));
        [self.value - below, self.value + above]
    }

    /// The score.
    pub(super) fn value(&self) -> f64 {
        self.value
    }

    /// Standard error, in the unit of the score.
    pub(super) fn standard_error(&self) -> f64 {
        self.standard_error
    }

    /// Degrees of freedom of the interval.
    pub fn freedom(&self) -> f64 {
        self.freedom
    }

    /// Distances from the value down and up to the ends of the interval with Student's t equal to `t`.
    pub(super) fn distances(&self, t: f64) -> [f64; 2] {
        let value = self.value;
        match self.shape {
            Shape::Own(steps) => steps.map(|step| t * step),
            Shape::Logarithm { end, steps } => {
                let distance = value - end;
                // Away from `end` if it is below, towards it if it is above.
                let sign = if distance < 0.0 { -1.0 } else { 1.0 };
                let [low, high] = steps.map(|step| sign * t * step);
                [
                    distance * (1.0 - exponential(-low)),
                    distance * (exponential(high) - 1.0),
                ]
            }
            Shape::Odds { width, steps } => {
                let (below, above) = (value, width - value);
                let at = |step: f64| width * below / (below + above * exponential(-step));
                let [low, high] = steps.map(|step| t * step);
                [value - at(-low), at(high) - value]
            }
            Shape::Share { samples } => {
                let [low, high] = super::wilson::ends(value, samples, t);
                [value - low, high - value]
            }
        }
    }
}

/// Given interval from a computed interval; `None` for an interval without ends, clusters, scale or degrees of freedom.
fn stated(interval: &Interval) -> Option<StatedInterval> {
    let (ends, freedom) = (interval.ends()?, interval.freedom()?);
    let stated = StatedInterval::new(ends, freedom, interval.clusters()?).on(interval.scale()?);
    Some(stated.with_standard_error(interval.standard_error()))
}

/// Degrees of freedom: number of clusters minus one.
fn freedom_of(clusters: usize) -> f64 {
    f64::from(u32::try_from(clusters.saturating_sub(1)).unwrap_or(u32::MAX))
}

/// Logarithmic scale with these `ends`, for the distance of the value from 0 or from 1. The more symmetric of both is returned.
fn logarithmic(value: f64, ends: [f64; 2], t: f64) -> Option<Shape> {
    let about = |end: f64| {
        let distances = ends.map(|of| (of - end) / (value - end));
        let logarithms = distances.map(|ratio| logarithm(ratio).abs());
        let [low, high] = logarithms;
        let is_one = low.is_finite() && high.is_finite();
        let steps = [low / t, high / t];
        is_one.then_some(((low - high).abs(), Shape::Logarithm { end, steps }))
    };
    nearest([about(0.0), about(1.0)])
}

/// Scale of the logarithm of the odds of value / width with these `ends`, for a width of 1 or 2. The more symmetric of both is returned.
fn odds(value: f64, ends: [f64; 2], t: f64) -> Option<Shape> {
    let within = |width: f64| {
        let odds = |of: f64| of / (width - of);
        let logarithms = ends.map(|end| logarithm(odds(end) / odds(value)).abs());
        let [low, high] = logarithms;
        let is_one = low.is_finite() && high.is_finite();
        let steps = [low / t, high / t];
        is_one.then_some(((low - high).abs(), Shape::Odds { width, steps }))
    };
    nearest([within(1.0), within(2.0)])
}

/// Shape with the smaller asymmetry, which is the first number of each pair.
fn nearest(shapes: [Option<(f64, Shape)>; 2]) -> Option<Shape> {
    let found = shapes.into_iter().flatten();
    let nearest = found.min_by(|(one, _), (other, _)| one.total_cmp(other));
    nearest.map(|(_, shape)| shape)
}

/// Wilson's interval of the share p with these ends. Its number of samples n follows from (p − L)² = t² L (1 − L) / n, for the end L farther from p.
fn share(value: f64, [low, high]: [f64; 2], t: f64) -> Option<Shape> {
    let end = if value - low > high - value {
        low
    } else {
        high
    };
    let distance = value - end;
    let samples = t * t * end * (1.0 - end) / (distance * distance);
    (samples.is_finite() && samples > 0.0).then_some(Shape::Share { samples })
}

/// Meaning of a score, in words: `mae/1 in N`, with its constants.
fn meaning(score: &Score) -> String {
    let constants = score.parameters.iter();
    let constants = constants.map(|constant| format!(", {} = {}", constant.name, constant.value));
    let start = format!("{} in {}", score.definition, score.unit);
    constants.fold(start, |all, constant| all + &constant)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::score::range::Range;
    use crate::stats::ends::{Estimated, Moved};

    /// Computes the interval of a value with this standard error, and an estimate from that interval.
    fn read_back(range: Range, value: f64, standard_error: f64) -> (Estimate, [f64; 2]) {
        let freedom = 7.5;
        let moved = Moved {
            standard_error,
            freedom,
            clusters: 12,
            carried: None,
        };
        let estimated = Estimated {
            value,
            range,
            samples: 1 << 40,
        };
        let ends = estimated.ends(&moved).expect("an interval");
        let both = [ends.low, ends.high];
        let stated = StatedInterval::new(both, freedom, 12).on(ends.scale);
        let stated = stated.with_standard_error(standard_error);
        let estimate = Estimate::try_from_interval(value, stated).expect("an estimate");
        (estimate, both)
    }

    #[test]
    fn at_its_own_level_an_estimate_has_the_interval_it_was_read_off() {
        for (range, value, error) in [
            (Range::Any, -0.3, 0.1),
            (Range::Positive, 0.5, 0.1),
            (Range::Positive, 12.0, 3.0),
            (Range::BelowOne, 0.9, 0.02),
            (Range::BelowOne, -0.4, 0.3),
            (Range::Ratio, 0.7, 0.1),
            (Range::BelowTwo, 0.7, 0.1),
            (Range::Share, 0.25, 0.05),
            (Range::Share, 1.0, 0.0),
        ] {
            let (estimate, [low, high]) = read_back(range, value, error);
            let [below, above] = estimate.distances(quantile(COVERAGE, 7.5));
            let close = |found: f64, expected: f64| (found - expected).abs() < 1e-12;
            assert!(
                close(below, value - low) && close(above, high - value),
                "{range:?} {value}: {below} {above}, not {low} {high}"
            );
        }
    }

    #[test]
    fn at_another_level_it_has_the_interval_of_that_scale() {
        // Half of t: the square root of each ratio.
        let half = quantile(COVERAGE, 7.5) / 2.0;
        let (estimate, [low, high]) = read_back(Range::Positive, 0.5, 0.1);
        let [below, above] = estimate.distances(half);
        assert!((0.5 - below - (0.5 * low).sqrt()).abs() < 1e-12);
        assert!((0.5 + above - (0.5 * high).sqrt()).abs() < 1e-12);
        let (estimate, [low, high]) = read_back(Range::BelowOne, 0.9, 0.02);
        let [below, above] = estimate.distances(half);
        assert!((0.1 + below - (0.1 * (1.0 - low)).sqrt()).abs() < 1e-12);
        assert!((0.1 - above - (0.1 * (1.0 - high)).sqrt()).abs() < 1e-12);
    }

    #[test]
    fn an_end_that_was_cut_is_no_measure() {
        let (estimate, [low, _]) = read_back(Range::NotNegative, 0.1, 0.2);
        assert!(low.abs() < 1e-300);
        let distances = estimate.distances(1.0).map(f64::to_bits);
        assert_eq!(distances, [0.2_f64, 0.2].map(f64::to_bits));
    }
}
