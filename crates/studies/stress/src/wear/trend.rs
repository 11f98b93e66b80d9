//! Growth of an error over the life of a gel, and the number of presses or days at which it reaches a limit.

use taceva_metrics::distributions::student_t;
use taceva_metrics::elementary::logarithm;
use taceva_metrology::curve::{CurveFit, CurveRow, CurveUndefined};

use crate::estimate::{Estimate, Undefined};
use crate::wear::report::LimitMet;

/// Share of Student's t distribution below the upper end of a 95 % interval.
const UPPER: f64 = 0.975;
/// Coverage of the two-sided interval whose lower end is a one-sided 95 % bound.
const ONE_SIDED: f64 = 0.90;

/// Error of a recording, with its age.
#[derive(Clone, Copy)]
pub(crate) struct ErrorAt {
    /// Age in steps, each of 1000 presses or 30 days.
    pub(crate) steps: f64,
    pub(crate) error: f64,
}

/// Least-squares line through the logarithms of the errors of recordings over their age. Each recording is one observation, of any number of samples.
pub(crate) struct Trend {
    line: Result<CurveFit, Undefined>,
    /// Error of the last recording; `None` without recordings.
    last: Option<f64>,
}

impl Trend {
    /// Fits the trend of `errors`, which are in the order of their age.
    pub(crate) fn of(errors: &[ErrorAt]) -> Trend {
        Trend {
            line: line(errors),
            last: errors.last().map(|of| of.error),
        }
    }

    /// Growth of the logarithm of the error in one step.
    pub(crate) fn slope(&self) -> Estimate {
        let line = match &self.line {
            Ok(line) => line,
            Err(reason) => return Estimate::undefined(*reason),
        };
        let slope = line.coefficients()[1];
        let ends = line.coefficient_uncertainty(1).map(|of| {
            let half = student_t::quantile(UPPER, of.freedom) * of.u;
            [slope - half, slope + half]
        });
        Estimate::new(slope, ends.ok_or(Undefined::NoInterval))
    }

    /// Presses or days at which a recording has the error `limit`. A step has `step` of them. The interval is Fieller's for one further recording.
    pub(crate) fn meets(&self, limit: f64, step: f64) -> LimitMet {
        let found = self.line.as_ref().map_err(|reason| *reason);
        let found = found.and_then(|line| {
            if line.coefficients()[1] <= 0.0 {
                return Err(Undefined::NotGrowing);
            }
            let found = line.invert(logarithm(limit), ONE_SIDED, 1);
            found.map_err(|_| Undefined::GrowthNotShown)
        });
        let place = |steps: f64| step * steps.max(0.0);
        let is_above = self.last.is_some_and(|error| error > limit);
        let reason = found.err();
        LimitMet {
            limit,
            at: found.ok().map(|found| place(found.x)),
            not_before: found.ok().map(|found| place(found.low)),
            reason: reason.map(|of| if is_above { Undefined::AboveLimit } else { of }),
        }
    }
}

/// Least-squares line through the logarithms of `errors` over the age.
fn line(errors: &[ErrorAt]) -> Result<CurveFit, Undefined> {
    if errors.iter().any(|of| of.error <= 0.0) {
        return Err(Undefined::ZeroError);
    }
    let row = |of: &ErrorAt| CurveRow::new(of.steps, logarithm(of.error));
    let rows: Vec<CurveRow> = errors.iter().map(row).collect();
    CurveFit::of(&rows, 1).map_err(|reason| match reason {
        CurveUndefined::TooFewRows { .. } => Undefined::TooFewRecordings,
        CurveUndefined::EqualX | CurveUndefined::TooFewX { .. } => Undefined::EqualPlaces,
        _ => Undefined::NoInterval,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Errors whose logarithm grows by `slope` in each step, plus `residuals`.
    fn grown(slope: f64, residuals: &[f64]) -> Vec<ErrorAt> {
        let places = (0_u32..).map(f64::from);
        let of = places.zip(residuals).map(|(steps, residual)| ErrorAt {
            steps,
            error: 0.05 * (slope * steps + residual).exp(),
        });
        of.collect()
    }

    #[test]
    fn a_doubling_error_has_its_slope_and_meets_its_limit_where_it_does() {
        let trend = Trend::of(&grown(std::f64::consts::LN_2, &[0.0; 4]));
        let slope = trend.slope().value.expect("four recordings");
        assert!((slope - std::f64::consts::LN_2).abs() < 1e-12, "{slope}");
        let met = trend.meets(0.8, 1000.0);
        assert!((met.at.expect("grows") - 4000.0).abs() < 1e-6, "{met:?}");
        let passed = trend.meets(0.01, 1000.0);
        assert_eq!((passed.at, passed.not_before), (Some(0.0), Some(0.0)));
    }

    #[test]
    fn residuals_widen_the_interval_and_lower_the_bound() {
        let trend = Trend::of(&grown(0.3, &[0.05, -0.08, 0.02, 0.06, -0.05]));
        let slope = trend.slope();
        let ([low, high], value) = (slope.ci95.expect("five"), slope.value.expect("five"));
        assert!(0.0 < low && low < value && value < high, "{slope:?}");
        let met = trend.meets(0.3, 30.0);
        let (at, bound) = (met.at.expect("grows"), met.not_before.expect("grows"));
        assert!(bound < at - 3.0, "{met:?}");
    }

    #[test]
    fn without_three_places_growth_or_an_error_the_reason_is_stated() {
        let reason = |errors: &[ErrorAt]| Trend::of(errors).slope().reason;
        let two = grown(0.3, &[0.0; 2]);
        assert_eq!(reason(&two), Some(Undefined::TooFewRecordings));
        let same = [two[0]; 3];
        assert_eq!(reason(&same), Some(Undefined::EqualPlaces));
        let mut zero = grown(0.3, &[0.0; 3]);
        zero[1].error = 0.0;
        assert_eq!(reason(&zero), Some(Undefined::ZeroError));
        let met = |errors: &[ErrorAt]| Trend::of(errors).meets(0.5, 1.0).reason;
        let falls = grown(-0.3, &[0.0, 0.01, 0.0]);
        assert_eq!(met(&falls), Some(Undefined::NotGrowing));
        let scattered = grown(0.1, &[0.5, -0.7, 0.6, 0.0]);
        assert_eq!(met(&scattered), Some(Undefined::GrowthNotShown));
    }

    #[test]
    fn a_last_error_above_its_limit_is_stated_where_no_place_is_known() {
        let met = |errors: &[ErrorAt], limit| Trend::of(errors).meets(limit, 1.0);
        let falls = grown(-0.3, &[0.0, 0.01, 0.0]);
        let scattered = grown(0.1, &[0.5, -0.7, 0.6, 0.0]);
        for errors in [&falls, &scattered, &grown(0.3, &[0.0; 2])] {
            let found = met(errors, 0.02);
            assert_eq!(
                (found.at, found.reason),
                (None, Some(Undefined::AboveLimit))
            );
        }
        // The first error is above this limit, and the last below.
        assert_eq!(met(&falls, 0.04).reason, Some(Undefined::NotGrowing));
        let grows = met(&grown(0.3, &[0.0; 4]), 0.04);
        assert_eq!((grows.at, grows.reason), (Some(0.0), None));
    }
}
