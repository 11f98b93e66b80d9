//! Models of other libraries: what such a model is, what it is fitted on, and how its fitted parameters are kept.
//!
//! An adapter implements [`LibraryLearner`] and [`LibraryPredictor`] and registers a [`LibraryModel`]; checks, scaling of features and
//! labels, the choice of settings and the model file are the same as for every other model.

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

/// Libraries whose models a program may offer; each is a feature of the program, called as the library.
pub(crate) const LIBRARIES: [&str; 2] = ["linfa", "smartcore"];

/// The library that a model called `name` is of: what stands before `/`, if it is one that a program may be built with.
pub(crate) fn library_of(name: &str) -> Option<&'static str> {
    let (library, _) = name.split_once('/')?;
    LIBRARIES.into_iter().find(|known| *known == library)
}

/// Every model of linfa and smartcore that this build has, the plainest of each first; none without the features `linfa` and `smartcore`.
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

/// A model of another library: its entry in the registry, what trying it takes, and how a fitted one is read back.
#[derive(Clone, Copy, Debug)]
pub struct LibraryModel {
    /// What people choose and set; the name is `library/model`.
    pub info: ModelInfo,
    /// Which release of the library fits, `linfa 0.8.1`.
    pub release: &'static str,
    /// Multiplications that one fit with default settings takes, for `auto`; `None` where it cannot be tried on parts of these sizes.
    pub(crate) work: fn(LibrarySizes) -> Option<f64>,
    /// The fitted parameters that a file keeps, for a model of these sizes.
    ///
    /// Errors: [`ModelError`] if a tensor is missing or a number is out of range; files may be damaged.
    pub(crate) load: fn(&LibraryTensors<'_>, LibrarySizes) -> LoadedPredictor,
}

/// An estimator of a library with its settings, not fitted yet.
pub(crate) trait LibraryLearner: Send + Sync {
    /// Its entry in the registry.
    fn model(&self) -> &'static LibraryModel;

    /// What all models of libraries have in common.
    fn settings(&self) -> LibrarySettings;

    /// The setting that is chosen by error, with the values that are tried, the plainest model last; one value where a person set it.
    fn candidates(&self) -> Option<(&'static str, Vec<f64>)> {
        None
    }

    /// Whether labels are classes: each prediction is one of the labels of the training part.
    fn is_classifier(&self) -> bool {
        false
    }

    /// Refuses what the library cannot learn from; `training` has whole, finite samples, at least two.
    ///
    /// # Errors
    /// [`ModelError`] of kind `InvalidArgument` with what would be accepted.
    fn check(&self, training: &TrainingSet<'_>) -> Result<(), ModelError> {
        let _ = training;
        Ok(())
    }

    /// Fits the library's estimator; a panic of the library is an error.
    ///
    /// # Errors
    /// [`ModelError`] if the library refuses or panics, or the fit was cancelled.
    fn fit(&self, task: &LibraryTask<'_>) -> Result<Box<dyn LibraryPredictor>, ModelError>;
}

impl LibraryModel {
    /// What a card says of a model that it fitted.
    pub(crate) fn card(&self) -> LibraryCard {
        let (library, _) = self.info.name.split_once('/').unwrap_or_default();
        LibraryCard {
            release: self.release.to_owned(),
            feature: library.to_owned(),
        }
    }
}

impl ModelInfo {
    /// The entry of a model of another library, which sees gray pictures of 32 × 32 where nothing else is asked for.
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
