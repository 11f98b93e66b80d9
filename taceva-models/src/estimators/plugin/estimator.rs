//! Adapter that makes a plugin's estimator a [`ModelEstimator`].

use std::sync::Arc;

use taceva_core::{Args, EstimatorFactory, FitRequest, ModelError, Progress, TrainingSet};

use super::regressor::PluginRegressor;
use crate::training::card::PluginCard;
use crate::training::choice::{Choice, errors};
use crate::training::fit::{ModelEstimator, ModelFit, estimator};
use crate::training::problem::Problem;
use crate::training::regressor::ModelRegressor;

/// Unfitted model of a plugin, with its settings.
pub(crate) struct PluginEstimator {
    pub(crate) factory: Arc<dyn EstimatorFactory>,
    pub(crate) settings: Args,
}

estimator!(PluginEstimator, |own| own.factory.key().as_str());

impl ModelEstimator for PluginEstimator {
    fn fit_model(
        &self,
        training: &TrainingSet<'_>,
        validation: Option<&TrainingSet<'_>>,
        progress: &dyn Progress,
    ) -> Result<ModelFit, ModelError> {
        let problem = Problem::new(*training)?;
        let validation = problem.validation(validation)?.and(validation);
        let fitted = self.factory.fit(
            &FitRequest::new(&self.settings, training, progress).with_validation(validation),
        )?;
        let bytes = fitted.save()?;
        let card = PluginCard::of(&*self.factory)?;
        let regressor = PluginRegressor::new(
            card,
            fitted,
            bytes,
            training.targets.channels,
            training.features.shape(),
        )?;
        let errors = match validation {
            Some(set) => errors(&regressor, set)?,
            None => vec![None; training.targets.channels.len()],
        };
        Ok(ModelFit {
            // A plugin does not report its use of the validation part.
            choice: Choice::nobodys(errors),
            regressor: ModelRegressor::new(regressor),
            scaling: problem.scaling,
            refitted: false,
        })
    }
}
