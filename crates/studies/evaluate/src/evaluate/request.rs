//! What is to be evaluated, and what comes of it.

use taceva_dataset::SensorFile;
use taceva_models::{Model, SplitManifest};

use crate::fit::FitRequest;
use crate::rows::DataPart;
use crate::state_file::StateFile;
use taceva_results::EvaluationReport;

/// What to evaluate.
#[derive(Debug)]
pub struct EvaluateRequest {
    /// The model, fitted or to be fitted.
    pub model: ModelChoice,
    /// Metrics and groups by name.
    pub metrics: Vec<String>,
    /// The part that is scored; what the model has not seen, if `None`.
    pub part: Option<DataPart>,
    /// What is known of the sensor beyond the dataset's header.
    pub sensor: Option<SensorFile>,
    /// True if the caller says that samples do not depend on each other, so that each is a point of its own in intervals.
    pub is_independent: bool,
}

/// What is asked for beside the model.
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
    /// What was kept, to be joined with that of other recordings.
    pub state: StateFile,
    /// How the dataset was divided, if it was.
    pub manifest: Option<SplitManifest>,
}
