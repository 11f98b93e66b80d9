//! Interface of estimators, and the result of a fit: a regressor for a model file, and the choices made.

use taceva_core::{Estimator, Features, ModelError, Progress, SignalInfo, TrainingSet};

use crate::features::FeatureError;
use crate::training::card::AutoCard;
use crate::training::checkpoint::Checkpoints;
use crate::training::choice::Choice;
use crate::training::label_scaling::LabelScaling;
use crate::training::regressor::ModelRegressor;

/// Implements [`Estimator`] for a [`ModelEstimator`], from an expression for the name and from `fit_model`.
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

/// Estimator whose regressor can be stored in a model file. A fit also reports the settings that it chose.
pub trait ModelEstimator: Estimator {
    /// Chooses a model for `training`, and returns its estimator with a record of the choice; `None` if the estimator is itself the model to fit.
    ///
    /// A classifier is chosen by its errors on `validation`. Networks may use `closer`: features of the same samples at a higher resolution.
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

    /// True if [`choose`](ModelEstimator::choose) would use features of higher resolution. The argument is `[samples, features, channels]`, with the
    /// number of features at that resolution. False for estimators that do not choose a model.
    fn looks_closer(&self, _: [usize; 3]) -> bool {
        false
    }

    /// Copy of the estimator that trains for only `share` of the epochs, for an early comparison of models; `None` for estimators without epochs.
    fn first_look(&self, _share: f64) -> Option<Box<dyn ModelEstimator>> {
        None
    }

    /// Fits a model as [`Estimator::fit`] does, and also returns the chosen settings and the label ranges.
    ///
    /// # Errors
    /// Errors of [`Estimator::fit`].
    fn fit_model(
        &self,
        training: &TrainingSet<'_>,
        validation: Option<&TrainingSet<'_>>,
        progress: &dyn Progress,
    ) -> Result<ModelFit, ModelError>;

    /// Estimator that replaces this estimator for taxel signals in the layout `info`; `None` if the same estimator fits pictures and signals.
    ///
    /// # Errors
    /// [`FeatureError::NarrowGrid`] if the grid is too small.
    fn of_signals(
        &self,
        _info: SignalInfo,
    ) -> Result<Option<Box<dyn ModelEstimator>>, FeatureError> {
        Ok(None)
    }

    /// Sets the checkpoint file. A training run then writes checkpoints, and resumes from them. Ignored by models that are fitted in one step.
    fn keep_checkpoints(&mut self, _: Checkpoints) {}
}

/// Result of an automatic choice among models.
pub struct Chosen {
    /// Chosen estimator.
    pub estimator: Box<dyn ModelEstimator>,
    /// Record of the trials.
    pub card: AutoCard,
    /// True if the estimator uses the features of higher resolution.
    pub is_closer: bool,
}

/// Result of a fit: the model, the chosen settings and the label ranges.
#[derive(Clone, Debug)]
pub struct ModelFit {
    /// Fitted model. Predictions have the units of the channels.
    pub regressor: ModelRegressor,
    /// Setting chosen for each channel, and its error.
    pub choice: Choice,
    /// Label range of each channel over the training part.
    pub scaling: LabelScaling,
    /// True if the model was refitted on the training and validation parts after its settings were chosen.
    pub refitted: bool,
}
