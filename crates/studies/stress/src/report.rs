//! Report of a stress test.

use std::collections::BTreeMap;

use serde::Serialize;

use taceva_results::{ModelProvenance, Provenance, Subject};

use crate::difference::ErrorDifference;
use crate::estimate::Estimate;
use crate::faults::LISTS;
use crate::ratio::Errors;
use crate::severity::{By, Unreached};

/// Name and version of the JSON schema of the report.
pub const STRESS_SCHEMA: &str = "taceva.stress/1.3";

/// Results by the name of a channel, such as `Fz`, or of a plane of two channels.
pub type ByChannel<T> = BTreeMap<String, T>;

/// Errors of a model on pictures or signals with faults.
#[derive(Clone, Debug, Serialize)]
pub struct StressReport {
    /// Name and version of the schema of this report.
    pub schema: &'static str,
    /// Sensor that was tested.
    pub subject: Subject,
    /// Warning that samples are, or may be, simulated or synthetic and not measured; `None` without such samples.
    pub not_measured: Option<String>,
    /// Quantity that sets severity.
    pub by: By,
    /// The list of faults.
    pub list: FaultList,
    /// Seed of all faults.
    pub seed: u64,
    /// Number of random draws of the positions of dead pixels, scratches, tears, dust and taxels.
    pub draws: u32,
    /// Number of predicted samples.
    pub samples: usize,
    /// Input of the model: `frame` or `signals`.
    pub input: &'static str,
    /// Number of samples of the scored part that have no picture.
    pub left_out: usize,
    /// Untouched picture or signals: `reference`, `least load`, or `none`.
    pub untouched: &'static str,
    /// Mean change of pictures by contact, a fraction of full scale, or of signals, in their unit; `None` if unknown.
    pub contact: Option<f64>,
    /// Unit of `contact`.
    pub contact_unit: &'static str,
    /// Unit of each channel.
    pub units: ByChannel<&'static str>,
    /// Errors without a fault, by channel.
    pub clean: ByChannel<CleanScore>,
    /// Faults, in the order of the list.
    pub faults: Vec<FaultReport>,
    /// Degradation as a mean over all faults, each a mean over its severities.
    #[serde(rename = "mD")]
    pub mean: ByChannel<Estimate>,
    /// Errors that are at least doubled by a fault of pictures or signals that no check finds. `None` for pictures without a reference.
    pub unnoticed: Option<Vec<Unnoticed>>,
    /// Skipped faults, with reasons.
    pub skipped: Vec<SkippedFault>,
    /// Faults of plugins that failed, with reasons.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub failed: Vec<SkippedFault>,
    /// Limitations of the scores, as sentences.
    pub notes: Vec<String>,
    /// Origin of the scores: data, model and program.
    pub provenance: Provenance,
    /// Model to whose errors `relative_error` and `difference` of each fault refer; `None` without a reference model.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reference: Option<ModelProvenance>,
    /// Scored rows, and their errors without a fault.
    #[serde(skip)]
    pub(crate) basis: Basis,
}

/// Scored rows, and their errors without a fault by contact point.
#[derive(Clone, Debug)]
pub(crate) struct Basis {
    pub(crate) rows: Vec<usize>,
    pub(crate) clean: ByChannel<Errors>,
}

/// List of faults. Scores of different lists are not compared.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct FaultList {
    /// Name with version, such as `gel-12/1`; the names of the faults if only some were requested.
    pub name: String,
    /// Digest of faults, severities and the quantity that sets them.
    pub digest: String,
}

/// Errors of a channel without a fault.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CleanScore {
    /// Mean absolute error over the scored samples.
    pub mae: Estimate,
    /// Skill relative to a constant prediction: above 0 if the model predicts better.
    pub skill: Estimate,
    /// Further metrics that the request names, by name.
    #[serde(skip_serializing_if = "ByChannel::is_empty")]
    pub metrics: ByChannel<Estimate>,
    /// Mean absolute error of a constant prediction; `None` if unknown.
    pub constant: Option<f64>,
}

/// Errors of a channel with a fault.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CellScore {
    /// Mean absolute error of the predictions over the scored samples, however large.
    pub mae: Estimate,
    /// Skill relative to a constant prediction: above 0 if the model predicts better.
    pub skill: Estimate,
    /// Further metrics that the request names, by name.
    #[serde(skip_serializing_if = "ByChannel::is_empty")]
    pub metrics: ByChannel<Estimate>,
    /// Degradation: the mean absolute error divided by that without the fault.
    pub degradation: Estimate,
    /// Mean absolute error, at most that of a constant prediction; `None` if one of them is unknown.
    pub capped: Option<f64>,
    /// Least and greatest degradation among the random draws of the fault; `None` for one draw.
    pub spread: Option<[f64; 2]>,
}

/// Results of one fault.
#[derive(Clone, Debug, Serialize)]
pub struct FaultReport {
    /// Name of the fault.
    pub id: String,
    /// Cause and appearance.
    pub title: String,
    /// Meaning and unit of the parameter.
    pub parameter: String,
    /// Sentence about a limitation of the scores of the fault; `None` without a limitation.
    pub note: Option<String>,
    /// Severities that were tested.
    pub severities: Vec<SeverityReport>,
    /// Severities that the fault cannot reach on this sensor.
    pub unreached: Vec<Unreached>,
    /// Degradation as a mean over the tested severities. The model uses the untouched picture from before the fault.
    #[serde(rename = "D")]
    pub mean: ByChannel<Estimate>,
    /// Share of the excess error that a new untouched picture removes. Excess is the sum of the logarithms of degradation over the severities.
    pub recovers: ByChannel<Estimate>,
    /// Least severity at which the interval of the skill is not above 0; 6 if there is none, `None` if an interval is missing.
    pub breaks_at: ByChannel<Option<u8>>,
    /// Severity at which no channel has skill, if higher severities were not tested for that reason. Means over severities are then lower bounds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stopped_at: Option<u8>,
    /// Error that the fault adds over all severities, divided by the error that it adds to the reference model; `None` without a reference model.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub relative_error: Option<ByChannel<Estimate>>,
    /// Error that the fault adds, minus the error that it adds to the reference model, each a mean over the severities of both reports; `None`
    /// without a reference model.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub difference: Option<ByChannel<ErrorDifference>>,
    /// Metrics of the times of rows (such as the frame rate) without the fault; empty for a fault that removes no rows.
    #[serde(skip_serializing_if = "ByChannel::is_empty")]
    pub times: ByChannel<TimeScore>,
    /// Errors by contact point, for each of `severities`.
    #[serde(skip)]
    pub(crate) errors: Vec<ByChannel<Errors>>,
}

impl FaultReport {
    /// True if the fault changes labels or times, but neither pictures nor signals. No check of pictures or signals can then find it.
    pub fn keeps_inputs(&self) -> bool {
        let mut known = LISTS.iter().flat_map(|list| list.faults);
        known.any(|fault| fault.id == self.id && (fault.is_of_labels() || fault.is_of_rows()))
    }
}

/// Value of a metric of the times of rows, such as the frame rate.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct TimeScore {
    /// The value; `None` if it is not defined.
    pub value: Option<f64>,
    /// Unit of the value.
    pub unit: &'static str,
}

/// Results of one fault at one severity.
#[derive(Clone, Debug, Serialize)]
pub struct SeverityReport {
    /// The severity.
    pub severity: u8,
    /// Parameter of the fault.
    pub parameter: f64,
    /// Mean change of the scored pictures or signals by the fault, as a ratio to the change by contact; `None` if the change by contact is unknown.
    pub stimulus: Option<f64>,
    /// True if the stimulus is below 0.05, so that the fault hardly changes the pictures or signals.
    pub low_stimulus: bool,
    /// Codes of the checks of pictures or taxels that find the fault in every random draw, and find nothing without the fault.
    pub check: Vec<&'static str>,
    /// Scores of predictions with the untouched picture from before the fault.
    pub stale: ByChannel<CellScore>,
    /// Scores of predictions with a new untouched picture, which has the fault; `None` without such a picture.
    pub fresh: Option<ByChannel<CellScore>>,
    /// Metrics of the times of rows with the fault, such as the frame rate; empty for a fault that removes no rows.
    #[serde(skip_serializing_if = "ByChannel::is_empty")]
    pub times: ByChannel<TimeScore>,
}

/// Error that a fault at least doubles, although no check of pictures or taxels finds the fault.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Unnoticed {
    /// Name of the fault.
    pub fault: String,
    /// The severity.
    pub severity: u8,
    /// Channel or plane of the error.
    pub channel: String,
}

/// Fault that the stress test skipped.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct SkippedFault {
    /// Name of the fault.
    pub fault: String,
    /// Reason for the skip.
    pub reason: String,
}
