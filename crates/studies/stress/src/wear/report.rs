//! Report of a comparison of recordings of one sensor unit.

use serde::Serialize;

use taceva_core::Date;
use taceva_results::{Provenance, Subject};

use crate::difference::ErrorDifference;
use crate::estimate::{Estimate, Undefined};
use crate::report::ByChannel;
use crate::wear::order::WearBy;

/// Name and version of the JSON schema of the report.
pub const WEAR_SCHEMA: &str = "taceva.wear/1";

/// Errors of a model on recordings of one unit, in the order of their age.
#[derive(Clone, Debug, Serialize)]
pub struct WearReport {
    /// Name and version of the schema of this report.
    pub schema: &'static str,
    /// Sensor that was compared.
    pub subject: Subject,
    /// Warning that samples are, or may be, simulated or synthetic and not measured; `None` without such samples.
    pub not_measured: Option<String>,
    /// Quantity that orders the recordings.
    pub by: WearBy,
    /// Number of presses or days for which the slopes are stated.
    pub step: f64,
    /// Unit of each channel.
    pub units: ByChannel<&'static str>,
    /// Gels of the unit, by name.
    pub gels: Vec<GelWear>,
    /// Limitations of the scores, as sentences.
    pub notes: Vec<String>,
}

/// Recordings of one gel, and the growth of their errors.
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
    /// Age of the gel: number of presses, or of days from its first recording.
    pub place: f64,
    /// Number of predicted samples.
    pub samples: usize,
    /// Number of samples that have no picture.
    pub left_out: usize,
    /// Untouched picture: `reference`, `least load`, or `none`.
    pub untouched: &'static str,
    /// Difference of the untouched picture from that of the first recording, divided by the mean change by contact there; `None` if unknown.
    pub stimulus: Option<f64>,
    /// Mean absolute error over the samples, by channel.
    pub mae: ByChannel<Estimate>,
    /// Differences of the mean absolute errors from those of the first recording, by channel; empty for the first recording.
    pub differences: ByChannel<ErrorDifference>,
    /// Origin of the scores: data, model and program.
    pub provenance: Provenance,
}

/// Growth of the error of one channel.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ChannelWear {
    /// Growth of the natural logarithm of the mean absolute error in one [`step`](WearReport::step) of presses or days.
    pub slope: Estimate,
    /// Presses or days at which the error reaches the limit of the channel; `None` without a limit.
    pub limit: Option<LimitMet>,
    /// Folder of the earliest recording whose error differs significantly from that of the first; `None` if there is none.
    pub first_different: Option<String>,
}

/// Presses or days at which an error reaches its limit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LimitMet {
    /// Limit of the error, in the unit of the channel.
    pub limit: f64,
    /// Number of presses, or of days from the first recording, at which the trend reaches the limit. At least 0; `None` if unknown.
    pub at: Option<f64>,
    /// One-sided 95 % bound of `at`: before this number of presses or days, the error of a recording is below the limit. `None` without a bound.
    pub not_before: Option<f64>,
    /// Reason why `at` is unknown; `None` if it is known.
    pub reason: Option<Undefined>,
}
