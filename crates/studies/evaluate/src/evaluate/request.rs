//! Requests and results of an evaluation.

use taceva_dataset::SensorFile;
use taceva_models::{Model, SplitManifest};

use crate::fit::FitRequest;
use crate::rows::DataPart;
use crate::state_file::StateFile;
use taceva_results::EvaluationReport;

/// Request of an evaluation.
#[derive(Debug)]
pub struct EvaluateRequest {
    /// The model, fitted or to be fitted.
    pub model: ModelChoice,
    /// Metrics and groups by name.
    pub metrics: Vec<String>,
    /// The part that is scored; `None` for the samples that the model has not seen.
    pub part: Option<DataPart>,
    /// Facts about the sensor beyond the dataset's header.
    pub sensor: Option<SensorFile>,
    /// True if the caller states that samples are independent, so that each is a point of its own in intervals.
    pub is_independent: bool,
}

/// The request without its model.
#[derive(Clone, Copy)]
pub struct Asked<'a> {
    pub(super) metrics: &'a [String],
    pub(super) part: Option<DataPart>,
    pub(super) sensor: Option<&'a SensorFile>,
    pub(super) is_independent: bool,
}

impl EvaluateRequest {
    /// The request without its model.
    pub fn asked(&self) -> Asked<'_> {
        Asked {
            metrics: &self.metrics,
            part: self.part,
            sensor: self.sensor.as_ref(),
            is_independent: self.is_independent,
        }
    }
}

/// The model: to be fitted, or finished.
#[derive(Debug)]
pub enum ModelChoice {
    /// Fitted on the training part first.
    Fit(FitRequest),
    /// Fitted before.
    Fitted(Box<Model>),
}

/// A finished evaluation.
#[derive(Debug)]
pub struct Evaluated {
    /// The scores and where they come from.
    pub report: EvaluationReport,
    /// The state, to be merged with that of other recordings.
    pub state: StateFile,
    /// The division of the dataset; `None` if it was not divided.
    pub manifest: Option<SplitManifest>,
}
