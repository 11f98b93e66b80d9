//! Ends of an interval, computed on an unbounded scale and transformed back.

use super::student::quantile;
use crate::count::as_f64;
use crate::elementary::{exponential, logarithm};
use crate::score::range::Range;
use crate::score::value::UndefinedReason;
use crate::score::{COVERAGE, Scale};

/// An estimate before its interval is computed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Estimated {
    /// Value of the estimate.
    pub(crate) value: f64,
    /// Range of the values that the quantity may have.
    pub(crate) range: Range,
    /// Number of samples of the estimate.
    pub(crate) samples: u64,
}

/// Variation of an estimate between clusters.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moved {
    /// Standard error, in the unit of the quantity.
    pub(crate) standard_error: f64,
    /// Degrees of freedom of the standard error.
    pub(crate) freedom: f64,
    /// Number of clusters with samples.
    pub(crate) clusters: usize,
    /// Standard error and degrees of freedom on the scale of a logarithm or of logarithmic odds; `None` if not computed there.
    pub(crate) carried: Option<[f64; 2]>,
}

impl Moved {
    /// Half-width on the unbounded scale: Student's t times the standard error. If the standard error is unknown there, `slope` converts it to first
    /// order: the derivative of that scale at the value.
    fn step(&self, slope: f64) -> f64 {
        let first_order = || [self.standard_error * slope, self.freedom];
        let [error, freedom] = self.carried.unwrap_or_else(first_order);
        quantile(COVERAGE, freedom) * error
    }

    /// Degrees of freedom of the ends on `scale`.
    fn freedom_on(&self, scale: Scale) -> f64 {
        match (scale, self.carried) {
            (Scale::Logarithm | Scale::Logit, Some([_, freedom])) => freedom,
            _ => self.freedom,
        }
    }
}

/// Lower and upper end of an interval, and the scale on which they were computed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ends {
    pub(crate) low: f64,
    pub(crate) high: f64,
    pub(crate) scale: Scale,
    /// Degrees of freedom of Student's t for the ends.
    pub(crate) freedom: f64,
}

/// Least ratio of two distances whose logarithm is used. A smaller ratio uses the tangent of the logarithm at this ratio.
const TANGENT: f64 = 0.7;

impl Estimated {
    /// 95 % interval of an estimate with the variation `moved`.
    ///
    /// Let h be Student's t times the standard error s. Without bounds the ends are value ± h. With one bound at distance d, the ends are d e^(±h)
    /// from the bound, with s of the logarithm of d. With two bounds, the same formula applies to the odds of the value. If s is known only in the
    /// unit of the quantity, the logarithm of d has the standard error s / d to first order. For a quantity that may equal a bound, value ± h is cut
    /// at the bound. A share p has Wilson's interval with t for z. Its number of samples is n* = p (1 − p) / s², at most the actual number. If p is
    /// 0 or 1, n* is the number of clusters.
    ///
    /// # Errors
    /// [`UndefinedReason::AtEnd`] if the value is at an end of its range and the standard error is 0;
    /// [`UndefinedReason::Overflow`] if an end is beyond the range of binary64.
    ///
    /// # Reference
    /// Dean and Pagano, Evaluating confidence interval methods for binomial proportions in clustered surveys, Journal of Survey
    /// Statistics and Methodology 3 (2015), for shares; Efron and Tibshirani, An Introduction to the Bootstrap (1993), 12.6
    /// and 13.6, for scales.
    pub(crate) fn ends(&self, moved: &Moved) -> Result<Ends, UndefinedReason> {
        if self.range == Range::Share {
            return Ok(self.within(
                wilson(self.value, self.samples, moved),
                Scale::Wilson,
                moved.freedom,
            ));
        }
        let value = self.value;
        let [least, greatest] = self.range.ends();
        let (below, above) = (value - least, greatest - value);
        let is_at_end = !(below > 0.0 && above > 0.0);
        if is_at_end && moved.standard_error <= 0.0 {
            return Err(UndefinedReason::AtEnd);
        }
        let half = quantile(COVERAGE, moved.freedom) * moved.standard_error;
        let (ends, scale) = match self.range {
            Range::Any => ([value - half, value + half], Scale::Own),
            Range::Positive if !is_at_end => {
                let step = moved.step(1.0 / below);
                let ends = [-step, step].map(|step| least + below * exponential(step));
                (ends, Scale::Logarithm)
            }
            Range::BelowOne if !is_at_end => {
                let step = moved.step(1.0 / above);
                let ends = [step, -step].map(|step| greatest - above * exponential(step));
                (ends, Scale::Logarithm)
            }
            Range::Ratio | Range::BelowTwo if !is_at_end => {
                let width = greatest - least;
                let step = moved.step(width / (below * above));
                let share = |step: f64| below / (below + above * exponential(-step));
                (
                    [-step, step].map(|step| least + width * share(step)),
                    Scale::Logit,
                )
            }
            _ => ([value - half, value + half], Scale::Cut),
        };
        let ends = self.within(ends, scale, moved.freedom_on(scale));
        if ends.low.is_finite() && ends.high.is_finite() {
            Ok(ends)
        } else {
            Err(UndefinedReason::Overflow)
        }
    }

    /// Distance from the value to `other` on the unbounded scale: the logarithm of a distance or of odds. `other` is another score, such as the score
    /// without one cluster. `None` if the quantity has no unbounded scale, or the value is at an end.
    ///
    /// Below [`TANGENT`] the logarithm of a distance is replaced by its tangent. If one cluster causes most of an error, the score without this
    /// cluster may be very small. Its logarithm would then not describe the other errors.
    pub(crate) fn carry(&self, other: f64) -> Option<f64> {
        let [least, greatest] = self.range.ends();
        let below = || (other - least) / (self.value - least);
        let above = || (greatest - other) / (greatest - self.value);
        let ratio = match self.range {
            Range::Positive => below(),
            Range::BelowOne => above(),
            Range::Ratio | Range::BelowTwo => {
                return Some(logarithm(below() / above())).filter(|carried| carried.is_finite());
            }
            _ => return None,
        };
        let carried = match ratio < TANGENT {
            true => logarithm(TANGENT) + (ratio - TANGENT) / TANGENT,
            false => logarithm(ratio),
        };
        Some(carried).filter(|carried| carried.is_finite())
    }

    /// Ends limited to the range of the quantity. The value stays between the ends in spite of rounding and cuts.
    pub(crate) fn within(&self, [low, high]: [f64; 2], scale: Scale, freedom: f64) -> Ends {
        let [least, greatest] = self.range.ends();
        Ends {
            low: low.max(least).min(self.value),
            high: high.min(greatest).max(self.value),
            scale,
            freedom,
        }
    }
}

fn wilson(share: f64, samples: u64, moved: &Moved) -> [f64; 2] {
    let samples = as_f64(samples);
    let binomial = share * (1.0 - share);
    let worth = if binomial > 0.0 {
        (binomial / moved.standard_error / moved.standard_error).min(samples)
    } else {
        u32::try_from(moved.clusters).map_or(samples, f64::from)
    };
    super::wilson::ends(share, worth, quantile(COVERAGE, moved.freedom))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ends about `value` for the half-width `half` in the unit of the quantity, from five clusters with ten samples.
    fn ends(range: Range, value: f64, half: f64) -> Result<Ends, UndefinedReason> {
        let estimated = Estimated {
            value,
            range,
            samples: 50,
        };
        estimated.ends(&Moved {
            standard_error: half / quantile(COVERAGE, 4.0),
            freedom: 4.0,
            clusters: 5,
            carried: None,
        })
    }

    fn close(found: Result<Ends, UndefinedReason>, expected: [f64; 2], scale: Scale) {
        let found = found.expect("an interval");
        assert!(
            (found.low - expected[0]).abs() < 1e-12 && (found.high - expected[1]).abs() < 1e-12,
            "{found:?}, not {expected:?}"
        );
        assert_eq!(found.scale, scale);
    }

    #[test]
    fn an_error_is_multiplied_and_divided_by_one_factor() {
        // ln 2 of ±0.5 × 2 ln 2 / 2.
        let half = 0.5 * std::f64::consts::LN_2;
        close(
            ends(Range::Positive, 0.5, half),
            [0.25, 1.0],
            Scale::Logarithm,
        );
    }

    #[test]
    fn an_explained_share_is_carried_by_what_is_not_explained() {
        let half = 0.1 * std::f64::consts::LN_2;
        close(
            ends(Range::BelowOne, 0.9, half),
            [0.8, 0.95],
            Scale::Logarithm,
        );
    }

    #[test]
    fn a_ratio_is_carried_by_its_odds() {
        // Odds 1, doubled and halved; p (1 − p) = 1/4.
        let half = 0.25 * std::f64::consts::LN_2;
        close(
            ends(Range::Ratio, 0.5, half),
            [1.0 / 3.0, 2.0 / 3.0],
            Scale::Logit,
        );
        close(
            ends(Range::BelowTwo, 1.0, 2.0 * half),
            [2.0 / 3.0, 4.0 / 3.0],
            Scale::Logit,
        );
    }

    #[test]
    fn what_was_found_on_the_scale_without_ends_is_taken_as_it_is() {
        let estimated = Estimated {
            value: 0.5,
            range: Range::Positive,
            samples: 50,
        };
        let found = estimated.ends(&Moved {
            standard_error: 1.0,
            freedom: 1.0,
            clusters: 5,
            carried: Some([std::f64::consts::LN_2 / quantile(COVERAGE, 4.0), 4.0]),
        });
        close(found, [0.25, 1.0], Scale::Logarithm);
    }

    #[test]
    fn distances_and_odds_are_carried_by_their_logarithms() {
        let carried = |range, value, other| {
            let samples = 50;
            let estimated = Estimated {
                value,
                range,
                samples,
            };
            estimated.carry(other).map(|carried| carried.exp())
        };
        let close = |found: Option<f64>, expected: f64| {
            let found = found.expect("on the scale");
            assert!((found / expected - 1.0).abs() < 1e-14, "{found}");
        };
        close(carried(Range::Positive, 0.5, 1.0), 2.0);
        close(carried(Range::BelowOne, 0.9, 0.8), 2.0);
        close(carried(Range::Ratio, 0.5, 0.75), 3.0);
        close(carried(Range::BelowTwo, 1.0, 0.5), 1.0 / 3.0);
        // Nothing is left without the cluster: the tangent, ln 0.7 − 1.
        close(carried(Range::Positive, 0.5, 0.0), 0.7 * (-1.0_f64).exp());
        close(carried(Range::BelowOne, 0.5, 1.0), 0.7 * (-1.0_f64).exp());
        assert_eq!(carried(Range::Ratio, 0.5, 1.0), None);
        assert_eq!(carried(Range::BelowOne, 1.0, 0.5), None);
        assert_eq!(carried(Range::Any, 0.5, 1.0), None);
    }

    #[test]
    fn a_quantity_that_may_be_at_an_end_is_cut_there() {
        close(ends(Range::NotNegative, 0.5, 1.0), [0.0, 1.5], Scale::Cut);
        close(ends(Range::RatioWithEnds, 0.9, 0.2), [0.7, 1.0], Scale::Cut);
        close(ends(Range::Positive, 0.0, 0.25), [0.0, 0.25], Scale::Cut);
        close(ends(Range::BelowOne, 1.0, 0.25), [0.75, 1.0], Scale::Cut);
    }

    #[test]
    fn a_value_that_no_cluster_moves_from_an_end_has_no_interval() {
        for (range, value) in [
            (Range::Positive, 0.0),
            (Range::BelowOne, 1.0),
            (Range::Ratio, 1.0),
            (Range::NotNegative, 0.0),
        ] {
            let found = ends(range, value, 0.0).map(|ends| [ends.low, ends.high]);
            assert_eq!(found, Err(UndefinedReason::AtEnd), "{range:?}");
        }
        close(
            ends(Range::Positive, 0.5, 0.0),
            [0.5, 0.5],
            Scale::Logarithm,
        );
    }

    #[test]
    fn a_share_that_is_all_or_nothing_is_known_from_as_many_as_there_are_clusters() {
        let t = quantile(COVERAGE, 4.0);
        let least = 5.0 / (5.0 + t * t);
        close(ends(Range::Share, 1.0, 0.0), [least, 1.0], Scale::Wilson);
        close(
            ends(Range::Share, 0.0, 0.0),
            [0.0, 1.0 - least],
            Scale::Wilson,
        );
    }

    #[test]
    fn a_share_is_known_from_no_more_samples_than_there_are() {
        let all_alike = ends(Range::Share, 0.5, 0.0).expect("an interval");
        let [low, high] = super::super::wilson::ends(0.5, 50.0, quantile(COVERAGE, 4.0));
        close(Ok(all_alike), [low, high], Scale::Wilson);
    }

    #[test]
    fn an_end_beyond_binary64_is_an_overflow() {
        let found = ends(Range::Positive, f64::MAX / 2.0, f64::MAX / 2.0);
        assert_eq!(found.map(|ends| ends.low), Err(UndefinedReason::Overflow));
    }
}
