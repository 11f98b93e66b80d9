//! What fitting gives, whichever kind of model it is: a regressor that a model file can keep, and what was chosen on the way.

use taceva_core::{Estimator, Features, ModelError, Progress, SignalInfo, TrainingSet};

use crate::features::FeatureError;
use crate::training::card::AutoCard;
use crate::training::checkpoint::Checkpoints;
use crate::training::choice::Choice;
use crate::training::label_scaling::LabelScaling;
use crate::training::regressor::ModelRegressor;

/// Implements [`Estimator`] for a [`ModelEstimator`]: its name, and the regressor that it fits.
macro_rules! estimator {
    ($estimator:ty, |$own:pat_param| $name:expr) => {
        impl taceva_core::Estimator for $estimator {
            fn name(&self) -> &str {
                let $own = self;
                $name
            }

            fn fit(
                &self,
                training: &taceva_core::TrainingSet<'_>,
                validation: Option<&taceva_core::TrainingSet<'_>>,
                progress: &dyn taceva_core::Progress,
            ) -> Result<Box<dyn taceva_core::Regressor>, taceva_core::ModelError> {
                use crate::training::fit::ModelEstimator as _;
                let fit = self.fit_model(training, validation, progress)?;
                Ok(Box::new(fit.regressor))
            }
        }
    };
}
pub(crate) use estimator;

/// An estimator whose regressor a model file can keep, and that can say what it chose.
pub trait ModelEstimator: Estimator {
    /// The estimator that takes the place of this one on `training`, and why; `None` for every one but that which only chooses. Some of those that it
    /// chooses from see finer features, `closer`, of the same samples, where there are such.
    ///
    /// # Errors
    /// As [`Estimator::fit`].
    fn choose(
        &self,
        _training: &TrainingSet<'_>,
        _closer: Option<&Features>,
        _progress: &dyn Progress,
    ) -> Result<Option<Chosen>, ModelError> {
        Ok(None)
    }

    /// Whether it would look at finer features in [`choose`](ModelEstimator::choose): so many samples of so many such features, and channels. `false`
    /// for every one but that which only chooses.
    fn looks_closer(&self, _: [usize; 3]) -> bool {
        false
    }

    /// The same with `share` of its training, for a first look at what it can do; `None` for every one but those that are trained step by step.
    fn first_look(&self, _share: f64) -> Option<Box<dyn ModelEstimator>> {
        None
    }

    /// Learns as [`Estimator::fit`] does.
    ///
    /// # Errors
    /// As [`Estimator::fit`].
    fn fit_model(
        &self,
        training: &TrainingSet<'_>,
        validation: Option<&TrainingSet<'_>>,
        progress: &dyn Progress,
    ) -> Result<ModelFit, ModelError>;

    /// The estimator that takes the place of this one where signals of `info` are learnt from; `None` for every one but those that are made for
    /// pictures.
    ///
    /// # Errors
    /// [`FeatureError::NarrowGrid`] if it cannot learn from a grid of so few places.
    fn of_signals(
        &self,
        _info: SignalInfo,
    ) -> Result<Option<Box<dyn ModelEstimator>>, FeatureError> {
        Ok(None)
    }

    /// Keeps checkpoints of trainings from now on, and resumes from what is found there; a model that is fitted in one step keeps none.
    fn keep_checkpoints(&mut self, _: Checkpoints) {}
}

/// A model that was chosen among others.
pub struct Chosen {
    /// The model.
    pub estimator: Box<dyn ModelEstimator>,
    /// What was tried, and what came of it.
    pub card: AutoCard,
    /// Whether it sees the finer features.
    pub is_closer: bool,
}

/// What fitting gave.
#[derive(Clone, Debug)]
pub struct ModelFit {
    /// The fitted model, in the units of the channels.
    pub regressor: ModelRegressor,
    /// What was chosen for each channel, and how well it did.
    pub choice: Choice,
    /// The label ranges of the training part.
    pub scaling: LabelScaling,
    /// Whether the validation part was learnt from too, once the settings were chosen.
    pub refitted: bool,
}
