//! What makes models of one kind: found by its key, configured by its settings, and able to load what it fitted before.

use crate::args::{ArgSpec, Args};
use crate::id::DriverKey;
use crate::model::{ModelError, Saved, SavedRegressor, TrainingSet};
use crate::progress::Progress;

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
    /// As [`Estimator::fit`](crate::Estimator::fit).
    fn fit(&self, request: &FitRequest<'_>) -> Result<Box<dyn SavedRegressor>, ModelError>;

    /// The fitted model that was kept.
    ///
    /// # Errors
    /// [`ModelError`] of kind `Protocol` for bytes that are none of its models; hostile ones are refused like damaged ones.
    fn load(&self, saved: &Saved<'_>) -> Result<Box<dyn SavedRegressor>, ModelError>;

    /// The digest of the library that it is in, `sha256:` and 64 hexadecimal digits; `None` where it is linked into the program.
    ///
    /// # Errors
    /// [`ModelError`] if the library cannot be read.
    fn build(&self) -> Result<Option<String>, ModelError> {
        Ok(None)
    }

    /// Whether a model that was fitted by the build `fitted_by` may be loaded by this one, which may say that it is odd.
    ///
    /// # Errors
    /// [`ModelError`] of kind `PermissionDenied` if only the very build may load it.
    fn admit(&self, fitted_by: Option<&str>) -> Result<(), ModelError> {
        let _ = fitted_by;
        Ok(())
    }
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
