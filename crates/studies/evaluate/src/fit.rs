//! Fit stage: fits a model on a dataset by a request.

mod features;
mod plan;
mod request;
mod training;

use taceva_dataset::Dataset;
use taceva_models::{Checkpoints, Model, SplitManifest};

use crate::error::EvaluateError;
use crate::rows::Divided;
use crate::work::Work;

pub use plan::FitPlan;
pub use request::FitRequest;
pub use request::Recipe;

/// A fitted model, and the division of its dataset.
#[derive(Debug)]
pub struct Fitted {
    /// The fitted model.
    pub model: Model,
    /// Division of the dataset.
    pub divided: Divided,
    /// Record of the division.
    pub manifest: SplitManifest,
    /// Number of frames decoded for the fit.
    pub frames_decoded: u64,
    /// Number of samples in the training and validation parts without a label or a frame.
    pub left_out: usize,
}

/// Fits a model on the training part of `dataset`.
///
/// A long training writes checkpoints to `checkpoints` and resumes from them. Models fitted in one step have no checkpoints.
///
/// # Errors
/// [`EvaluateError`] if the request is not valid, the dataset cannot be read, or no model can be fitted to it.
pub fn fit(
    dataset: &Dataset,
    request: &FitRequest,
    checkpoints: Option<Checkpoints>,
    work: Work<'_>,
) -> Result<Fitted, EvaluateError> {
    let mut plan = FitPlan::new(dataset, request)?;
    if let Some(checkpoints) = checkpoints {
        plan.keep_checkpoints(checkpoints);
    }
    plan.run(work)
}
