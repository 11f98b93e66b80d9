//! Selects the model with the least error on held-out samples, within a limit on computing work.

mod candidates;
mod classes;
mod cost;
mod entrant;
mod excess;
mod race;
mod settlement;
mod validate;

use taceva_core::{Features, ModelError, Progress, SignalInfo, TrainingSet, counted};

use self::candidates::candidates;
use self::classes::HEAD;
use self::cost::{NETWORK, Sizes};
use self::race::{Made, Race};
use self::validate::Folds;
use crate::estimators::library::LibraryModel;
use crate::estimators::network::NetworkEstimator;
use crate::estimators::registry::{ALL, DEFAULT};
use crate::features::{FeatureError, FeatureSpec};
use crate::linalg::invalid;
use crate::settings::{ModelSettings, SettingError, SettingInfo, number};
use crate::training::card::FOLDS;
use crate::training::checkpoint::Checkpoints;
use crate::training::file::error::FormatError;
use crate::training::fit::{Chosen, ModelEstimator, ModelFit, estimator};
use crate::training::info::ModelInfo;
use crate::training::problem::Problem;

/// Tries models, the cheapest first, and chooses the best.
///
/// The training part is divided into five folds of whole groups, or of consecutive samples. A trial learns from three folds, chooses settings on the
/// fourth and computes its error on the fifth. All models are tried on the first fold. The small network first trains for a quarter of its epochs,
/// and for all epochs if this training decides nothing. If the network is clearly ahead, it is chosen, and costlier models are not tried.
///
/// Otherwise the other models continue to the next fold. A model drops out if the best model is ahead by three standard errors of the mean difference
/// over groups or runs. It also drops out if a model with less than a tenth of its work has no greater error. Of the remaining models, the model with
/// the least error is chosen. The baseline is chosen unless this model is better by more than two standard errors. The network replaces this choice
/// if its squared error on the first fold is smaller by more than two standard errors and by 5 %.
///
/// With `head=classes`, only classifiers are fitted to the training part. The choice is the classifier with the least share of wrong labels on the
/// validation part, averaged over distinct labels.
///
/// The budget limits work, not time. Its unit is one second of a core that does 10⁹ multiplications per second. A model is tried if its trial and its
/// final fit do not exceed the remaining budget. Work depends on the numbers of samples, features and channels. The same recording therefore leads to
/// the same choice on every machine, under any load and with any number of threads. Baseline and ridge are always tried.
#[derive(Clone, Debug)]
pub struct Auto {
    budget_s: f64,
    /// True if only classifiers are candidates. The validation part then decides.
    predicts_classes: bool,
    /// Library models to try in addition to the models of this crate.
    libraries: Vec<&'static LibraryModel>,
    /// Signals that serve as features; `None` for pictures.
    of_signals: Option<SignalInfo>,
    /// Checkpoints for the training of a network, if a network is chosen.
    checkpoints: Option<Checkpoints>,
}

const BUDGET: SettingInfo = SettingInfo {
    key: "budget_s",
    accepts: "a number from 0 to 1e6",
    default: "1800",
    about: "budget of work for trying models and fitting the chosen one, in seconds of a core at a thousand million multiplications per \
            second: about processor seconds, see docs/models.md; 1800 allows a network on some thousand frames",
};

impl Auto {
    /// Registry entry of the model `auto`.
    pub const INFO: ModelInfo = ModelInfo {
        name: "auto",
        about: "the best of the other models on held-out samples, residual networks excluded, within a budget of work",
        settings: &[BUDGET, HEAD],
        features: Some(FeatureSpec::DEFAULT),
        make: |settings| Ok(Box::new(Auto::from_settings(settings)?)),
        // A model file names the chosen model instead.
        load: |_| Err(FormatError::Card),
    };

    /// Builds the estimator from `settings`.
    ///
    /// # Errors
    /// [`SettingError`] for an unknown key or a value out of range.
    pub fn from_settings(settings: &ModelSettings) -> Result<Auto, SettingError> {
        settings.check_keys(Auto::INFO.settings)?;
        Ok(Auto {
            budget_s: settings.value(&BUDGET, 1800.0, |text| number(text, 0.0..=1e6))?,
            predicts_classes: settings.value(&HEAD, false, |text| match text {
                "numbers" => Some(false),
                "classes" => Some(true),
                _ => None,
            })?,
            libraries: Vec::new(),
            of_signals: None,
            checkpoints: None,
        })
    }

    /// Adds library models to the candidates.
    #[must_use]
    pub fn among(mut self, libraries: &[&'static LibraryModel]) -> Auto {
        self.libraries.extend(libraries);
        self
    }
}

impl Auto {
    /// Builds the estimator of `info` with default settings, adapted to signals if the features are signals. The network uses the default preset.
    fn candidate(&self, info: &ModelInfo) -> Made {
        let settings = match info.name == NETWORK {
            true => DEFAULT.of_model(),
            false => ModelSettings::default(),
        };
        let estimator = info
            .estimator(&settings)
            .map_err(|error| invalid(error.to_string()).because(error))?;
        let of_signals = self.of_signals.map(|info| estimator.of_signals(info));
        Ok(match of_signals.transpose() {
            Ok(other) => Ok(other.flatten().unwrap_or(estimator)),
            Err(error) => Err(error),
        })
    }

    /// Features for networks, on a finer grid than the features of other models. Used for large enough frames, unless the user sets a grid.
    pub(crate) const CLOSER: Option<FeatureSpec> = NetworkEstimator::CNN.features;
}

impl ModelEstimator for Auto {
    fn of_signals(
        &self,
        info: SignalInfo,
    ) -> Result<Option<Box<dyn ModelEstimator>>, FeatureError> {
        let mut own = self.clone();
        own.of_signals = Some(info);
        Ok(Some(Box::new(own)))
    }

    fn looks_closer(&self, [samples, features, channels]: [usize; 3]) -> bool {
        if self.predicts_classes {
            return false;
        }
        let sizes = Sizes {
            samples: samples as f64,
            features: features as f64,
            picture: Some(features as f64),
            channels: channels as f64,
        };
        let candidates = candidates(ALL, &self.libraries, sizes);
        let mut networks = candidates.iter().filter(|own| own.is_network());
        networks.any(|own| own.first_s() + own.fit_s <= self.budget_s)
    }

    fn choose(
        &self,
        training: &TrainingSet<'_>,
        validation: Option<&TrainingSet<'_>>,
        closer: Option<&Features>,
        progress: &dyn Progress,
    ) -> Result<Option<Chosen>, ModelError> {
        if self.predicts_classes {
            let chosen = self.choose_classifier(training, validation, progress)?;
            return Ok(Some(chosen));
        }
        let problem = Problem::new(*training)?;
        let samples = training.features.samples();
        if samples < FOLDS {
            return Err(invalid(format!(
                "{}, expected at least {FOLDS} to try models",
                counted(samples, "training sample")
            )));
        }
        let mut pictures = *training;
        pictures.features = closer.unwrap_or(training.features);
        if pictures.features.samples() != samples {
            return Err(invalid(format!(
                "{samples} training samples, but finer features of {} samples, expected equal numbers",
                pictures.features.samples()
            )));
        }
        let shape = pictures.features.shape();
        let sizes = Sizes {
            samples: samples as f64,
            features: training.features.shape().len() as f64,
            picture: (shape.height > 1).then_some(shape.len() as f64),
            channels: problem.channels() as f64,
        };
        let make = |info: &ModelInfo| self.candidate(info);
        let race = Race {
            budget_s: self.budget_s,
            make: &make,
            folds: Folds::new(training, problem.groups()),
            pictures,
            training: *training,
            progress,
            spent_s: 0.0,
            entrants: Vec::new(),
            network: Vec::new(),
            untried: Vec::new(),
        };
        let (taken, card) = race.run(candidates(ALL, &self.libraries, sizes))?;
        let estimator = self.candidate(taken.info)?;
        let mut estimator = estimator.map_err(|error| invalid(error.to_string()).because(error))?;
        if let Some(checkpoints) = &self.checkpoints {
            estimator.keep_checkpoints(checkpoints.clone());
        }
        let is_closer = closer.is_some() && taken.is_network();
        Ok(Some(Chosen {
            estimator,
            card,
            is_closer,
        }))
    }

    fn keep_checkpoints(&mut self, checkpoints: Checkpoints) {
        self.checkpoints = Some(checkpoints);
    }

    fn fit_model(
        &self,
        training: &TrainingSet<'_>,
        validation: Option<&TrainingSet<'_>>,
        progress: &dyn Progress,
    ) -> Result<ModelFit, ModelError> {
        let chosen = self.choose(training, validation, None, progress)?;
        let chosen = chosen.expect("this estimator chooses");
        chosen.estimator.fit_model(training, validation, progress)
    }
}

estimator!(Auto, |_| Auto::INFO.name);
