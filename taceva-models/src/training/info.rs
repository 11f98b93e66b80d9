//! A model before its settings are known.

use crate::features::FeatureSpec;
use crate::settings::{ModelSettings, SettingError, SettingInfo};
use crate::training::file::content::Load;
use crate::training::fit::ModelEstimator;

/// A model that people can choose: its name, what it is, and what can be set.
#[derive(Clone, Copy, Debug)]
pub struct ModelInfo {
    /// The word people type.
    pub name: &'static str,
    /// What it is, in one line.
    pub about: &'static str,
    /// What can be set.
    pub settings: &'static [SettingInfo],
    /// What it sees of a frame where nothing else is asked for; `None` if its predictions do not depend on what is seen, so that no
    /// frame need be decoded for it.
    pub features: Option<FeatureSpec>,
    pub(crate) make: fn(&ModelSettings) -> Result<Box<dyn ModelEstimator>, SettingError>,
    /// Loads a fitted one.
    pub(crate) load: Load,
}

impl ModelInfo {
    /// The model as `settings` ask for, not fitted yet.
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
