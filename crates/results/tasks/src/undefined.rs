//! Reasons for a missing score of a task.

use std::fmt;

use serde::Serialize;
use taceva_metrics::UndefinedReason;

/// Reason why samples determine no score of a task.
///
/// ```
/// use taceva_tasks::Undefined;
/// assert_eq!(Undefined::OneClass.to_string(), "one class only");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[non_exhaustive]
pub enum Undefined {
    /// There is no sample.
    Empty,
    /// All samples are of one class.
    OneClass,
    /// No sample is of the positive class.
    NoPositive,
    /// No sample is predicted as the class.
    NoPrediction,
    /// No sample is of the negative class.
    NoNegative,
    /// Some scores are not probabilities: outside 0 to 1, or with a sum other than 1 over the classes.
    NotProbabilities,
    /// A sample's true class has probability 0, so the logarithmic loss is infinite.
    InfiniteLoss,
    /// The first k places contain all classes.
    TooManyPlaces,
    /// The task has no thresholds for bins.
    NoThresholds,
    /// The object, or a cloud, has no point.
    NoPoints,
    /// No pixel is valid in both maps.
    NoValidPixel,
    /// The truth has no contact.
    NoContact,
    /// Neither truth nor prediction has contact.
    BothEmpty,
    /// The task states no size of a pixel.
    NoPixelSize,
    /// There is no true or predicted onset.
    NoOnset,
    /// No predicted onset matches a true onset.
    NoMatch,
    /// A sequence has no times.
    NoTimes,
    /// All sequences have a duration of 0.
    NoDuration,
}

impl Undefined {
    /// Reason for the missing interval of a score without a value.
    pub(crate) fn of_interval(self) -> UndefinedReason {
        match self {
            Undefined::Empty => UndefinedReason::Empty,
            _ => UndefinedReason::NoInterval,
        }
    }
}

impl fmt::Display for Undefined {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Undefined::Empty => "no sample",
            Undefined::OneClass => "one class only",
            Undefined::NoPositive => "no positive sample",
            Undefined::NoPrediction => "no sample is predicted as the class",
            Undefined::NoNegative => "no negative sample",
            Undefined::NotProbabilities => {
                "the scores are not probabilities: expected numbers from 0 to 1 whose sum is 1 within 1e-6; write seven decimals or more"
            },
            Undefined::InfiniteLoss => "a true class has probability 0",
            Undefined::TooManyPlaces => "the first k places contain all classes",
            Undefined::NoThresholds => "the task has no thresholds",
            Undefined::NoPoints => "no points",
            Undefined::NoValidPixel => "no pixel is valid in truth and prediction",
            Undefined::NoContact => "no contact in the truth",
            Undefined::BothEmpty => "no contact in truth and prediction",
            Undefined::NoPixelSize => "the task has no size of a pixel",
            Undefined::NoOnset => "no onset",
            Undefined::NoMatch => "no matched onset",
            Undefined::NoTimes => "frames without times",
            Undefined::NoDuration => "no time passes",
        })
    }
}
