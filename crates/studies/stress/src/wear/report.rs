//! Result of a comparison of recordings of one unit.

use serde::Serialize;

use taceva_core::Date;
use taceva_results::{Provenance, Subject};

use crate::difference::ErrorDifference;
use crate::estimate::{Estimate, Undefined};
use crate::report::ByChannel;
use crate::wear::order::WearBy;

/// Schema of the result.
pub const WEAR_SCHEMA: &str = "taceva.wear/1";

/// Errors of a model on recordings of one unit, in the order of their age.
#[derive(Clone, Debug, Serialize)]
pub struct WearReport {
    /// Schema of the result.
    pub schema: &'static str,
    /// The sensor.
    pub subject: Subject,
    /// Statement on samples that were not measured; `None` if all were.
    pub not_measured: Option<String>,
    /// Quantity that orders the recordings.
    pub by: WearBy,
    /// Number of presses or days in one step, for which a slope is stated.
    pub step: f64,
    /// Unit of each channel.
    pub units: ByChannel<&'static str>,
    /// Gels of the unit, by name.
    pub gels: Vec<GelWear>,
    /// Limitations of the scores, as sentences.
    pub notes: Vec<String>,
}

/// Recordings of one gel.
#[derive(Clone, Debug, Serialize)]
pub struct GelWear {
    /// Name of the gel.
    pub gel: String,
    /// Recordings of the gel, in order.
    pub recordings: Vec<RecordingWear>,
    /// Growth of the error of each channel.
    pub channels: ByChannel<ChannelWear>,
}

/// Scores of one recording.
#[derive(Clone, Debug, Serialize)]
pub struct RecordingWear {
    /// Folder of the recording.
    pub recording: String,
    /// Origin of the samples, as in [`Subject::source`].
    pub source: String,
    /// Presses on the gel before the recording, if they are stated.
    pub presses_since_gel: Option<u32>,
    /// First day of the recording, if it is known.
    pub day: Option<Date>,
    /// Presses on the gel, or days from its first recording.
    pub place: f64,
    /// Number of predicted samples.
    pub samples: usize,
    /// Number of samples that have no picture.
    pub left_out: usize,
    /// Untouched picture: `reference`, `least load`, or `none`.
    pub untouched: &'static str,
    /// Change of the untouched picture since the first recording, divided by the mean change by contact in the first recording; `None` if unknown.
    pub stimulus: Option<f64>,
    /// Mean absolute errors.
    pub mae: ByChannel<Estimate>,
    /// Differences of the errors from the errors of the first recording; empty for the first recording.
    pub differences: ByChannel<ErrorDifference>,
    /// Origin of the numbers.
    pub provenance: Provenance,
}

/// Growth of the error of one channel.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ChannelWear {
    /// Growth of the natural logarithm of the error in one step of presses or days.
    pub slope: Estimate,
    /// Place at which the limit of the channel is met; `None` without a limit.
    pub limit: Option<LimitMet>,
    /// Folder of the first recording whose error is shown to differ from the error of the first recording; `None` without such a recording.
    pub first_different: Option<String>,
}

/// Place at which an error meets its limit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LimitMet {
    /// The limit, in the unit of the channel.
    pub limit: f64,
    /// Presses on the gel, or days from its first recording, at which the trend meets the limit; 0 for a place below 0, `None` if unknown.
    pub at: Option<f64>,
    /// One-sided 95 % bound: the error of a recording before this place is below the limit. `None` without a bound.
    pub not_before: Option<f64>,
    /// Reason for an absent place; `None` if the place is known.
    pub reason: Option<Undefined>,
}
