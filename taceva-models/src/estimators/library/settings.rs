//! Settings shared by all library models.

use crate::linalg::FeatureScale;
use crate::settings::{ModelSettings, SettingError, SettingInfo};

/// Values of the shared settings: feature scaling and refit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct LibrarySettings {
    pub(crate) scale: FeatureScale,
    pub(crate) refit: bool,
}

impl LibrarySettings {
    /// Switch: divides each feature by its standard deviation over the training part.
    pub(crate) const SCALE: SettingInfo = FeatureScale::SETTING;
    /// Switch: fits the model again on training and validation parts with the chosen settings.
    pub(crate) const REFIT: SettingInfo = SettingInfo::REFIT;

    /// Reads the shared settings from `settings`.
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
