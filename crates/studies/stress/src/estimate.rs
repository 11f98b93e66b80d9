//! Results of a stress test with their intervals, and the reasons for absent results and intervals.

use std::fmt;

use serde::Serialize;
use taceva_metrics::{Interval, Score, UndefinedReason, Value};

/// Greatest value that counts as 0, because rounding errors alone can cause it.
const ROUNDING: f64 = 1e-9;

/// Reason why a number or its interval is absent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Undefined {
    /// No sample has a label of the channel.
    Empty,
    /// The error without a fault is zero, so no ratio to it exists.
    ZeroBaseline,
    /// All labels are equal, so a constant prediction has no error to compare with.
    ConstantTruth,
    /// The fault does not add to the error, so a new untouched picture cannot remove any added error.
    NoExcess,
    /// The model reads no untouched picture (one without contact), or no untouched picture with the fault is usable.
    NoFreshReference,
    /// The samples name no contact points or groups.
    NoClusters,
    /// The samples come from fewer than five contact points or groups.
    TooFewClusters,
    /// No interval exists: the error depends on a single contact point or is zero, or the result is a share of the excess error.
    NoInterval,
    /// The fault reaches no severity on this sensor.
    NoSeverity,
    /// No significant effect of the fault on the error of the reference model was found.
    ReferenceUnmoved,
    /// Fewer than three recordings of the gel have a value of this error.
    TooFewRecordings,
    /// All recordings have the same number of presses, or the same day.
    EqualPlaces,
    /// The error of a recording is zero, which has no logarithm.
    ZeroError,
    /// The error does not grow with wear, so it will not reach the limit.
    NotGrowing,
    /// The growth of the error with wear is not statistically significant.
    GrowthNotShown,
    /// The error of the last recording already exceeds the limit. The number of presses or the day at which it reached the limit is unknown.
    AboveLimit,
}

impl fmt::Display for Undefined {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Undefined::Empty => "no label",
            Undefined::ZeroBaseline => "the error without the fault is 0",
            Undefined::ConstantTruth => "all labels are equal",
            Undefined::NoExcess => "the fault adds no error",
            Undefined::NoFreshReference => {
                "no untouched picture or signals were taken after the fault"
            }
            Undefined::NoClusters => "no contact points",
            Undefined::TooFewClusters => "fewer than five contact points",
            Undefined::NoInterval => "no interval",
            Undefined::NoSeverity => "no severity was reached",
            Undefined::ReferenceUnmoved => "the error of the reference model does not grow",
            Undefined::TooFewRecordings => "fewer than three recordings",
            Undefined::EqualPlaces => "all recordings have the same presses or day",
            Undefined::ZeroError => "an error is zero",
            Undefined::NotGrowing => "the error does not grow",
            Undefined::GrowthNotShown => "no growth is shown",
            Undefined::AboveLimit => "the error of the last recording is above the limit",
        })
    }
}

/// A number with its 95 % interval, or the reason for a missing interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Estimate {
    /// The number; `None` if it is absent.
    pub value: Option<f64>,
    /// Both ends of its 95 % interval; `None` if the interval is absent.
    pub ci95: Option<[f64; 2]>,
    /// Reason why the number is absent, or why its interval is absent; `None` if both are known or no reason is stated.
    pub reason: Option<Undefined>,
}

impl Estimate {
    /// Takes the value and the interval of a score.
    pub(crate) fn of(score: &Score) -> Estimate {
        let Some(value) = score.value.scalar() else {
            return Estimate::undefined(match score.value {
                Value::Undefined(UndefinedReason::ConstantTruth { .. }) => Undefined::ConstantTruth,
                _ => Undefined::Empty,
            });
        };
        let interval = match (score.interval.ends(), &score.interval) {
            (Some(ends), _) => Ok(ends),
            (None, Interval::Undefined(UndefinedReason::TooFewClusters { .. })) => {
                Err(Undefined::TooFewClusters)
            }
            (None, _) => Err(Undefined::NoInterval),
        };
        Estimate::new(value, interval)
    }

    /// A number, with its interval or the reason why the interval is absent.
    pub(crate) fn new(value: f64, interval: Result<[f64; 2], Undefined>) -> Estimate {
        Estimate {
            value: Some(value),
            ci95: interval.ok(),
            reason: interval.err(),
        }
    }

    /// A number without an interval; absent without a reason if it is unknown.
    pub fn of_known(value: Option<f64>) -> Estimate {
        Estimate {
            value,
            ci95: None,
            reason: None,
        }
    }

    /// Absent number, with the reason.
    pub(crate) fn undefined(reason: Undefined) -> Estimate {
        Estimate {
            value: None,
            ci95: None,
            reason: Some(reason),
        }
    }

    /// True if the interval is above 0. False if it is not, or if the number itself is not above 0. `None` if neither is known.
    pub fn is_above_zero(&self) -> Option<bool> {
        match self.value? {
            value if value <= ROUNDING => Some(false),
            _ => Some(self.low()? > 0.0),
        }
    }

    /// Lower end of the interval; `None` without an interval.
    pub(crate) fn low(&self) -> Option<f64> {
        self.ci95.map(|[low, _]| low)
    }
}
