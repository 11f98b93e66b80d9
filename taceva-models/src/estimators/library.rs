//! Models of other libraries: interface, training data and storage of fitted parameters.
//!
//! An adapter implements [`LibraryLearner`] and [`LibraryPredictor`], and registers a [`LibraryModel`]. Checks, scaling of features and labels,
//! choice of settings, and the model file are the same as for models of this crate.

#[cfg(any(feature = "linfa", feature = "smartcore"))]
mod adapter;
mod answers;
mod estimator;
mod fit;
#[cfg(any(feature = "linfa", feature = "smartcore"))]
mod guard;
#[cfg(feature = "linfa")]
mod linfa;
#[cfg(any(feature = "linfa", feature = "smartcore"))]
mod predictor;
mod regressor;
mod settings;
#[cfg(feature = "smartcore")]
mod smartcore;
#[cfg(any(feature = "linfa", feature = "smartcore"))]
mod span;
#[cfg(any(feature = "linfa", feature = "smartcore"))]
mod support_vector;
mod task;
mod tensor;

use taceva_core::{ModelError, TrainingSet};

#[cfg(any(feature = "linfa", feature = "smartcore"))]
pub(crate) use self::estimator::library_estimator;
pub use self::regressor::LibraryRegressor;
pub(crate) use self::settings::LibrarySettings;
pub(crate) use self::task::{LibraryPredictor, LibrarySizes, LibraryTask, LoadedPredictor};
pub(crate) use self::tensor::LibraryTensors;
use crate::features::FeatureSpec;
use crate::settings::{ModelSettings, SettingError, SettingInfo};
use crate::training::card::LibraryCard;
use crate::training::fit::ModelEstimator;
use crate::training::info::ModelInfo;

/// Names of supported libraries. Each library is a Cargo feature of the same name.
pub(crate) const LIBRARIES: [&str; 2] = ["linfa", "smartcore"];

/// Name of the library that provides the model `name`: the part before `/`. `None` if this part is not a supported library.
pub(crate) fn library_of(name: &str) -> Option<&'static str> {
    let (library, _) = name.split_once('/')?;
    LIBRARIES.into_iter().find(|known| *known == library)
}

/// All models of linfa and smartcore in this build, for each library the simplest first. Empty without the features `linfa` and `smartcore`.
///
/// ```
/// use taceva_models::{Models, library_models};
/// let models = Models::builtin().with_libraries(library_models());
/// assert_eq!(models.find("linfa/pls").is_ok(), cfg!(feature = "linfa"));
/// ```
pub fn library_models() -> impl Iterator<Item = &'static LibraryModel> {
    #[cfg(feature = "linfa")]
    let of_linfa = linfa::ALL;
    #[cfg(not(feature = "linfa"))]
    let of_linfa: &[&LibraryModel] = &[];
    #[cfg(feature = "smartcore")]
    let of_smartcore = smartcore::ALL;
    #[cfg(not(feature = "smartcore"))]
    let of_smartcore: &[&LibraryModel] = &[];
    of_linfa.iter().chain(of_smartcore).copied()
}

/// A model of another library: registry entry, cost and loader.
#[derive(Clone, Copy, Debug)]
pub struct LibraryModel {
    /// Registry entry, named `library/model`.
    pub info: ModelInfo,
    /// Release of the library, such as `linfa 0.8.1`.
    pub release: &'static str,
    /// Number of multiplications of one fit with default settings, for the model `auto`. `None` if the sizes are not supported.
    pub(crate) work: fn(LibrarySizes) -> Option<f64>,
    /// Builds the fitted model from the tensors of a file and its sizes.
    ///
    /// Returns [`ModelError`] if a tensor is missing or a number is out of range, as in damaged files.
    pub(crate) load: fn(&LibraryTensors<'_>, LibrarySizes) -> LoadedPredictor,
}

/// Unfitted estimator of a library with its settings.
pub(crate) trait LibraryLearner: Send + Sync {
    /// Registry entry of the model.
    fn model(&self) -> &'static LibraryModel;

    /// Values of the settings shared by all library models.
    fn settings(&self) -> LibrarySettings;

    /// Name and candidate values of the setting that is chosen by held-out error. The value of the simplest model comes last. Contains one value if
    /// the user set it; `None` if the model has no such setting.
    fn candidates(&self) -> Option<(&'static str, Vec<f64>)> {
        None
    }

    /// True for classifiers, which predict one of the training labels.
    fn is_classifier(&self) -> bool {
        false
    }

    /// Rejects training sets that the library does not support. `training` has at least two samples. All their values are present and finite.
    ///
    /// # Errors
    /// [`ModelError`] of kind `InvalidArgument` with the accepted values.
    fn check(&self, training: &TrainingSet<'_>) -> Result<(), ModelError> {
        let _ = training;
        Ok(())
    }

    /// Fits the library's estimator. A panic of the library becomes an error.
    ///
    /// # Errors
    /// [`ModelError`] if the library fails or panics, or the fit was cancelled.
    fn fit(&self, task: &LibraryTask<'_>) -> Result<Box<dyn LibraryPredictor>, ModelError>;
}

impl LibraryModel {
    /// Entry of the model card for the library that fitted the model.
    pub(crate) fn card(&self) -> LibraryCard {
        let (library, _) = self.info.name.split_once('/').unwrap_or_default();
        LibraryCard {
            release: self.release.to_owned(),
            feature: library.to_owned(),
        }
    }
}

impl ModelInfo {
    /// Builds the registry entry of a library model. The default features are gray pictures of 32 × 32 pixels.
    pub(crate) const fn of_library(
        name: &'static str,
        about: &'static str,
        settings: &'static [SettingInfo],
        make: fn(&ModelSettings) -> Result<Box<dyn ModelEstimator>, SettingError>,
    ) -> ModelInfo {
        ModelInfo {
            name,
            about,
            settings,
            features: Some(FeatureSpec::DEFAULT),
            make,
            load: LibraryRegressor::load,
        }
    }
}
