//! Kernel ridge regression.

use taceva_core::{ModelError, Progress, TrainingSet};

use super::{Kernel, Mapped};
use crate::estimators::linear::{LinearEstimator, LinearFit};
use crate::estimators::ridge::Ridge;
use crate::features::FeatureSpec;
use crate::linalg::progress::interrupted;
use crate::settings::{ModelSettings, SettingError};
use crate::training::fit::{ModelEstimator, ModelFit, estimator};
use crate::training::info::ModelInfo;
use crate::training::problem::Problem;
use crate::training::regressor::ModelRegressor;

use super::regressor::KernelRegressor;

/// Kernel ridge regression on landmarks: [`Ridge`] on Nyström features, with a separate penalty for each channel.
///
/// The kernel length is common to all channels. The chosen length has the least sum of squared errors relative to label ranges. The penalties are
/// chosen on the same samples.
///
/// # Reference
/// C. Saunders, A. Gammerman, V. Vovk, ICML 1998, 515.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KernelRidge {
    kernel: Kernel,
    refit: bool,
}

impl KernelRidge {
    /// Registry entry of kernel ridge regression.
    pub const INFO: ModelInfo = ModelInfo {
        name: "kernel-ridge",
        about: "kernel ridge regression: fits labels that are not a linear function of the picture",
        settings: Kernel::SETTINGS,
        features: Some(FeatureSpec::DEFAULT),
        make: |settings| Ok(Box::new(KernelRidge::from_settings(settings)?)),
        load: KernelRegressor::load,
    };

    /// Builds the estimator from `settings`.
    ///
    /// # Errors
    /// [`SettingError`] for an unknown key or a value out of range.
    pub fn from_settings(settings: &ModelSettings) -> Result<KernelRidge, SettingError> {
        settings.check_keys(KernelRidge::INFO.settings)?;
        Ok(KernelRidge {
            kernel: Kernel::from_settings(settings)?,
            refit: settings.refit()?,
        })
    }
}

/// Fits ridge regression at each kernel length of `kernel`, and returns the best fit with its map to Nyström features.
pub(super) fn fit_best(
    kernel: &Kernel,
    refit: bool,
    training: &TrainingSet<'_>,
    validation: Option<&TrainingSet<'_>>,
    progress: &dyn Progress,
) -> Result<(Mapped, LinearFit), ModelError> {
    let problem = Problem::new(*training)?;
    let held = problem.validation(validation)?;
    let validation = validation.filter(|_| held.is_some());
    let landmarks = kernel.landmarks(training.features, progress)?;
    let ridge = Ridge::unscaled(refit);
    let mut best: Option<(f64, Mapped, LinearFit)> = None;
    for &length in kernel.lengths().iter().rev() {
        interrupted(progress)?;
        let mapped = Mapped::new(&landmarks, length, validation.map(|set| set.features));
        let fit = ridge.fit_linear(
            &mapped.training(training),
            mapped.validation(validation).as_ref(),
            progress,
        )?;
        let spans = problem.scaling.span();
        let errors = fit.choice.channels.iter().zip(spans);
        let score: f64 = errors
            .map(|(choice, span)| {
                choice
                    .rmse
                    .map_or(f64::INFINITY, |rmse| (rmse / span).powi(2))
            })
            .sum();
        // The simplest fit comes first, and only a better fit replaces it.
        if best.as_ref().is_none_or(|(least, ..)| score < *least) {
            best = Some((score, mapped, fit));
        }
    }
    let (_, mapped, fit) = best.expect("there is a length to try");
    Ok((mapped, fit))
}

impl ModelEstimator for KernelRidge {
    fn fit_model(
        &self,
        training: &TrainingSet<'_>,
        validation: Option<&TrainingSet<'_>>,
        progress: &dyn Progress,
    ) -> Result<ModelFit, ModelError> {
        let (mapped, fit) = fit_best(&self.kernel, self.refit, training, validation, progress)?;
        let shape = training.features.shape();
        let regressor = KernelRegressor::new(shape, mapped.map, fit.regressor, None);
        Ok(ModelFit {
            regressor: ModelRegressor::new(regressor),
            choice: fit.choice,
            scaling: fit.scaling,
            refitted: fit.refitted,
        })
    }
}

estimator!(KernelRidge, |_| KernelRidge::INFO.name);
