//! Estimators that a plugin provides.

mod kept;
mod progress;
mod table;

use taceva_core::{
    ArgSpec, Args, DriverKey, ModelError, Progress, Saved, SavedRegressor, TrainingSet,
};

pub(crate) use table::table;

/// An estimator that is found by its key, with settings that it declares, and whose fitted models can be kept.
pub trait EstimatorFactory: Send + Sync {
    /// The name by which people choose it: the id of the plugin, `/`, and a word.
    fn key(&self) -> &DriverKey;

    /// What it is, in a few words.
    fn title(&self) -> &str;

    /// What can be set.
    fn settings(&self) -> &[ArgSpec] {
        &[]
    }

    /// Learns from what `request` holds.
    ///
    /// # Errors
    /// As [`Estimator::fit`](taceva_core::Estimator::fit).
    fn fit(&self, request: &FitRequest<'_>) -> Result<Box<dyn SavedRegressor>, ModelError>;

    /// The fitted model that was kept.
    ///
    /// # Errors
    /// [`ModelError`] of kind `Protocol` for bytes that are none of its models; hostile ones are refused like damaged ones.
    fn load(&self, saved: &Saved<'_>) -> Result<Box<dyn SavedRegressor>, ModelError>;
}

/// What a fit is made from.
pub struct FitRequest<'a> {
    /// What was set, checked against what the estimator declares.
    pub settings: &'a Args,
    /// Samples to learn from.
    pub training: &'a TrainingSet<'a>,
    /// Samples to choose settings by.
    pub validation: Option<&'a TrainingSet<'a>>,
    /// Who listens, and may cancel.
    pub progress: &'a dyn Progress,
}
