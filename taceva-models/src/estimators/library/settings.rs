//! Settings that every model of a library has.

use crate::linalg::FeatureScale;
use crate::settings::{ModelSettings, SettingError, SettingInfo};

/// How features are scaled before the library sees them, and what is learnt from once the settings are chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct LibrarySettings {
    pub(crate) scale: FeatureScale,
    pub(crate) refit: bool,
}

impl LibrarySettings {
    /// Whether each feature is divided by its standard deviation over the training part.
    pub(crate) const SCALE: SettingInfo = FeatureScale::SETTING;
    /// Whether the validation part is learnt from too, once the settings are chosen.
    pub(crate) const REFIT: SettingInfo = SettingInfo::REFIT;

    /// What `settings` ask for.
    ///
    /// # Errors
    /// [`SettingError`] for a value out of range.
    pub(crate) fn from_settings(settings: &ModelSettings) -> Result<LibrarySettings, SettingError> {
        Ok(LibrarySettings {
            scale: FeatureScale::from_settings(settings)?,
            refit: settings.refit()?,
        })
    }
}
