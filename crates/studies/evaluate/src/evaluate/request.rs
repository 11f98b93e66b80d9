//! Requests and results of an evaluation.

use taceva_dataset::{Dataset, SensorFile};
use taceva_models::{Model, SplitManifest};

use crate::error::EvaluateError;
use crate::fit::FitRequest;
use crate::neighbours::Resemblance;
use crate::rows::DataPart;
use crate::state_file::StateFile;
use taceva_results::EvaluationReport;

/// Request for an evaluation.
#[derive(Debug)]
pub struct EvaluateRequest {
    /// The model, already fitted or to be fitted.
    pub model: ModelChoice,
    /// Names of metrics and of groups of metrics.
    pub metrics: Vec<String>,
    /// Part to score; `None` for the samples that the model has not seen.
    pub part: Option<DataPart>,
    /// Facts of the sensor that complement the header of the dataset, if any.
    pub sensor: Option<SensorFile>,
    /// True if the caller states that samples are independent. For intervals, each sample then counts as one contact point.
    pub is_independent: bool,
}

/// Request for an evaluation, without its model.
#[derive(Clone, Copy)]
pub struct Asked<'a> {
    pub(super) metrics: &'a [String],
    pub(super) part: Option<DataPart>,
    pub(super) sensor: Option<&'a SensorFile>,
    pub(super) is_independent: bool,
}

impl EvaluateRequest {
    /// Returns the request without its model.
    pub fn asked(&self) -> Asked<'_> {
        Asked {
            metrics: &self.metrics,
            part: self.part,
            sensor: self.sensor.as_ref(),
            is_independent: self.is_independent,
        }
    }

    /// Rejects `is_independent` if neighbouring samples resemble each other.
    pub(super) fn check_independence(&self, dataset: &Dataset) -> Result<(), EvaluateError> {
        if !self.is_independent {
            return Ok(());
        }
        match Resemblance::of(dataset, &dataset.all_rows()) {
            Resemblance::Alike(found) => Err(EvaluateError::Request(format!(
                "--independent: {found}, so intervals over samples would be too narrow; omit --independent, or import the rows in the order of pressing if they were sorted by their labels"
            ))),
            Resemblance::Apart | Resemblance::Unknown => Ok(()),
        }
    }
}

/// The model of an evaluation: to be fitted, or already fitted.
#[derive(Debug)]
pub enum ModelChoice {
    /// A model to be fitted on the training part.
    Fit(FitRequest),
    /// A model that is already fitted.
    Fitted(Box<Model>),
}

/// Result of an evaluation.
#[derive(Debug)]
pub struct Evaluated {
    /// Scores and their provenance.
    pub report: EvaluationReport,
    /// Sums behind the scores, which can be merged with those of other recordings.
    pub state: StateFile,
    /// Record of the division of the dataset; `None` if it was not divided.
    pub manifest: Option<SplitManifest>,
    /// Probabilities of the classes of a task, sample by sample in the order of the report; `None` if the model estimates none.
    pub(crate) shares: Option<Vec<f64>>,
}
