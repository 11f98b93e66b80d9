//! Interface of estimators, and the result of a fit: a regressor for a model file, and the choices made.

use taceva_core::{Estimator, Features, ModelError, Progress, SignalInfo, TrainingSet};

use crate::features::FeatureError;
use crate::training::card::AutoCard;
use crate::training::checkpoint::Checkpoints;
use crate::training::choice::Choice;
use crate::training::label_scaling::LabelScaling;
use crate::training::regressor::ModelRegressor;

/// Implements [`Estimator`] for a [`ModelEstimator`], from its name and `fit_model`.
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

/// An estimator whose regressor can be stored in a model file, and that reports its choices.
pub trait ModelEstimator: Estimator {
    /// Chooses another estimator for `training`, and returns it with a record of the choice; `None` for estimators that do not choose.
    ///
    /// Classifiers are chosen by `validation`. Some candidates use the finer features `closer` of the same samples, if given.
    ///
    /// # Errors
    /// Errors of [`Estimator::fit`].
    fn choose(
        &self,
        _training: &TrainingSet<'_>,
        _validation: Option<&TrainingSet<'_>>,
        _closer: Option<&Features>,
        _progress: &dyn Progress,
    ) -> Result<Option<Chosen>, ModelError> {
        Ok(None)
    }

    /// True if [`choose`](ModelEstimator::choose) would use finer features for the given `[samples, finer features, channels]`. False for estimators that do
    /// not choose.
    fn looks_closer(&self, _: [usize; 3]) -> bool {
        false
    }

    /// Copy of the estimator with `share` of its training, for a first comparison; `None` for estimators that are not trained step by step.
    fn first_look(&self, _share: f64) -> Option<Box<dyn ModelEstimator>> {
        None
    }

    /// Fits like [`Estimator::fit`].
    ///
    /// # Errors
    /// Errors of [`Estimator::fit`].
    fn fit_model(
        &self,
        training: &TrainingSet<'_>,
        validation: Option<&TrainingSet<'_>>,
        progress: &dyn Progress,
    ) -> Result<ModelFit, ModelError>;

    /// Estimator that replaces this estimator for signals of `info`; `None` for estimators that are not specific to pictures.
    ///
    /// # Errors
    /// [`FeatureError::NarrowGrid`] if the grid is too small.
    fn of_signals(
        &self,
        _info: SignalInfo,
    ) -> Result<Option<Box<dyn ModelEstimator>>, FeatureError> {
        Ok(None)
    }

    /// Enables checkpoints. A training run then writes checkpoints and resumes from them. Ignored by models that are fitted in one step.
    fn keep_checkpoints(&mut self, _: Checkpoints) {}
}

/// Result of an automatic choice among models.
pub struct Chosen {
    /// Chosen estimator.
    pub estimator: Box<dyn ModelEstimator>,
    /// Record of the trials.
    pub card: AutoCard,
    /// True if the estimator uses the finer features.
    pub is_closer: bool,
}

/// Result of a model fit.
#[derive(Clone, Debug)]
pub struct ModelFit {
    /// Fitted model, in the units of the channels.
    pub regressor: ModelRegressor,
    /// Chosen setting and error of each channel.
    pub choice: Choice,
    /// Label ranges of the training part.
    pub scaling: LabelScaling,
    /// True if the model was refitted on training and validation parts with the chosen settings.
    pub refitted: bool,
}
