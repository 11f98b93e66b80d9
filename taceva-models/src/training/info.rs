//! Registry entries of models.

use crate::features::FeatureSpec;
use crate::settings::{ModelSettings, SettingError, SettingInfo};
use crate::training::file::content::Load;
use crate::training::fit::ModelEstimator;

/// Registry entry of a model: name, description and settings.
#[derive(Clone, Copy, Debug)]
pub struct ModelInfo {
    /// Name of the model on the command line.
    pub name: &'static str,
    /// Description of the model in one line.
    pub about: &'static str,
    /// Settings that the model accepts.
    pub settings: &'static [SettingInfo],
    /// Default features; `None` if predictions do not depend on features, so that callers need not decode frames.
    pub features: Option<FeatureSpec>,
    pub(crate) make: fn(&ModelSettings) -> Result<Box<dyn ModelEstimator>, SettingError>,
    /// Function that loads a fitted model from the content of a model file.
    pub(crate) load: Load,
}

impl ModelInfo {
    /// Builds the estimator of the model with `settings`.
    ///
    /// # Errors
    /// [`SettingError`] for an unknown key or a value out of range.
    pub fn estimator(
        &self,
        settings: &ModelSettings,
    ) -> Result<Box<dyn ModelEstimator>, SettingError> {
        (self.make)(settings)
    }
}
