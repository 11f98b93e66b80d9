//! Models of other libraries: what such a model is, what it is handed, and how its fitted parameters are kept.
//!
//! An adapter implements [`LibraryLearner`] and [`LibraryPredictor`] and registers a [`LibraryModel`]; checks, scaling of features and
//! labels, the choice of settings and the model file are the same as for every other model.

mod estimator;
mod fitted;
mod regressor;
mod settings;
mod tensor;

use serde::{Deserialize, Serialize};
use taceva_core::{ModelError, Progress, TrainingSet};

pub(crate) use self::estimator::LibraryEstimator;
pub use self::regressor::LibraryRegressor;
pub use self::settings::LibrarySettings;
pub use self::tensor::{LibraryTensor, LibraryTensors, Numbers};
use crate::features::FeatureSpec;
use crate::registry::ModelInfo;
use crate::settings::{SettingError, SettingInfo, Settings};
use crate::training::fit::ModelEstimator;

/// Libraries whose models a program may offer; each is a feature of the program, called as the library.
pub(crate) const LIBRARIES: [&str; 2] = ["linfa", "smartcore"];

/// The library that a model called `name` is of: what stands before `/`, if it is one that a program may be built with.
pub(crate) fn library_of(name: &str) -> Option<&'static str> {
    let (library, _) = name.split_once('/')?;
    LIBRARIES.into_iter().find(|known| *known == library)
}

/// A model of another library: its entry in the registry, what trying it takes, and how a fitted one is read back.
#[derive(Clone, Copy, Debug)]
pub struct LibraryModel {
    /// What people choose and set; the name is `library/model`.
    pub info: ModelInfo,
    /// Which release of the library fits, `linfa 0.8.1`.
    pub release: &'static str,
    /// Multiplications that one fit with default settings takes, for `auto`; `None` where it cannot be tried on parts of these sizes.
    pub work: fn(LibrarySizes) -> Option<f64>,
    /// The fitted parameters that a file keeps, for a model of these sizes.
    ///
    /// Errors: [`ModelError`] if a tensor is missing or a number is out of range; files may be damaged.
    pub load: fn(&LibraryTensors, LibrarySizes) -> LoadedPredictor,
}

/// A predictor that is read back, or why tensors are none.
pub type LoadedPredictor = Result<Box<dyn LibraryPredictor>, ModelError>;

/// Sizes that a model of a library is fitted on, or was.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LibrarySizes {
    /// Training samples; 0 for a model that is read back.
    pub samples: usize,
    /// Features that vary over them.
    pub features: usize,
    /// Channels whose labels vary over them.
    pub targets: usize,
}

/// What a library is handed: features that all vary, labels that all vary, every number finite.
#[derive(Clone, Copy)]
pub struct LibraryTask<'a> {
    /// How many samples, features and targets.
    pub sizes: LibrarySizes,
    /// `[samples, features]`, centred and scaled; each is exactly a single-precision number.
    pub rows: &'a [f64],
    /// `[samples, targets]`: labels scaled to 0..1 by the training part and centred; as they are where they are classes.
    pub labels: &'a [f64],
    /// `[targets]`: the value of the setting that is chosen, for each target; empty where there is none.
    pub values: &'a [f64],
    /// Who listens, and may cancel between calls of the library.
    pub progress: &'a dyn Progress,
}

impl LibraryTask<'_> {
    /// The labels of one target, sample by sample.
    pub fn target(&self, target: usize) -> Vec<f64> {
        let labels = self.labels.iter().skip(target);
        labels.step_by(self.sizes.targets.max(1)).copied().collect()
    }
}

/// An estimator of a library with its settings, not fitted yet.
pub trait LibraryLearner: Send + Sync {
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

/// Fitted parameters of a library's estimator, and how they predict.
pub trait LibraryPredictor: Send + Sync {
    /// What a file keeps of it; [`LibraryModel::load`] makes the same predictor of them, to the bit.
    fn tensors(&self) -> Vec<LibraryTensor>;

    /// Predicts one sample.
    ///
    /// # Shapes
    /// `sample`: `[features]`, as the rows of [`LibraryTask`]; `into`: `[targets]`, in the labels of the task.
    /// # Errors
    /// [`ModelError`] if the library refuses or panics.
    fn predict(&self, sample: &[f32], into: &mut [f64]) -> Result<(), ModelError>;
}

/// What a card says of the library that fitted a model.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct LibraryCard {
    /// The release that fitted it, `linfa 0.8.1`.
    pub release: String,
    /// The feature that a program needs in order to read the model.
    pub feature: String,
}

impl LibraryCard {
    pub(crate) fn of(model: &LibraryModel) -> LibraryCard {
        let (library, _) = model.info.name.split_once('/').unwrap_or_default();
        LibraryCard {
            release: model.release.to_owned(),
            feature: library.to_owned(),
        }
    }
}

impl ModelInfo {
    /// The entry of a model of another library, which sees gray pictures of 32 × 32 where nothing else is asked for.
    pub const fn of_library(
        name: &'static str,
        about: &'static str,
        settings: &'static [SettingInfo],
        make: fn(&Settings) -> Result<Box<dyn ModelEstimator>, SettingError>,
    ) -> ModelInfo {
        ModelInfo {
            name,
            about,
            settings,
            features: Some(FeatureSpec::DEFAULT),
            make,
        }
    }
}

/// The estimator of `learner`, as the registry makes it.
pub fn library_estimator(learner: impl LibraryLearner + 'static) -> Box<dyn ModelEstimator> {
    Box::new(LibraryEstimator::new(Box::new(learner)))
}
