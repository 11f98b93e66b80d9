//! Baseline: predicts the mean of the training part. Every other model should have a smaller error.

use taceva_core::{ModelError, Progress, TrainingSet};

use crate::estimators::linear::{LinearEstimator, LinearFit, LinearRegressor};
use crate::settings::{ModelSettings, SettingError};
use crate::training::choice::{Choice, rmse};
use crate::training::fit::estimator;
use crate::training::info::ModelInfo;
use crate::training::label_scaling::label_means;
use crate::training::problem::Problem;

/// Predicts the mean of the training part for every sample.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Baseline;

impl Baseline {
    /// Registry entry of the model `baseline`.
    pub const INFO: ModelInfo = ModelInfo {
        name: "baseline",
        about: "predicts the mean of the training part: every other model should have a smaller error",
        settings: &[],
        features: None,
        make: |settings| Ok(Box::new(Baseline::from_settings(settings)?)),
        load: LinearRegressor::load,
    };

    /// Builds the estimator, which has no settings.
    ///
    /// # Errors
    /// [`SettingError::Unknown`] for any setting.
    pub fn from_settings(settings: &ModelSettings) -> Result<Baseline, SettingError> {
        settings.check_keys(Baseline::INFO.settings)?;
        Ok(Baseline)
    }
}

impl LinearEstimator for Baseline {
    fn fit_linear(
        &self,
        training: &TrainingSet<'_>,
        validation: Option<&TrainingSet<'_>>,
        _progress: &dyn Progress,
    ) -> Result<LinearFit, ModelError> {
        let problem = Problem::new(*training)?;
        let validation = problem.validation(validation)?;
        let channels = problem.channels();
        let spans = problem.scaling.span();
        // Bitwise equal to the constant of the model card, so that rounding never appears as skill.
        let bias = label_means(training.targets);
        let error = |channel: usize| {
            let labels = validation.as_ref()?.labels.col_as_slice(channel);
            let squares: f64 = labels.iter().map(|label| label * label).sum();
            rmse(squares / labels.len() as f64, spans[channel])
        };
        Ok(LinearFit {
            choice: Choice::nobodys((0..channels).map(error)),
            regressor: LinearRegressor::new(
                training.targets.channels.clone(),
                training.features.shape(),
                vec![0.0; channels * training.features.shape().len()],
                bias,
            )?,
            scaling: problem.scaling,
            refitted: false,
        })
    }
}

estimator!(Baseline, |_| Baseline::INFO.name);
