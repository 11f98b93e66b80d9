//! Gaussian process on landmarks, with settings chosen by maximum likelihood.

use std::borrow::Cow;

use faer::Mat;
use taceva_core::{Features, ModelError, Progress, Regressor, TrainingSet};

use super::likelihood::{likeliest, ratios};
use super::reach::reach;
use super::regressor::KernelRegressor;
use super::uncertainty::Uncertainty;
use super::{Kernel, Mapped};
use crate::estimators::linear::LinearRegressor;
use crate::features::FeatureSpec;
use crate::linalg::progress::interrupted;
use crate::linalg::{Design, FeatureScale, Spectrum};
use crate::settings::{ModelSettings, SettingError};
use crate::training::choice::{ChannelChoice, Choice, ChosenBy, rmse};
use crate::training::fit::{ModelEstimator, ModelFit, estimator};
use crate::training::info::ModelInfo;
use crate::training::problem::{Problem, Validation, centred, joined, stacked};
use crate::training::regressor::ModelRegressor;

/// Gaussian process regression by the Nyström approximation, with predictive standard deviations.
///
/// Each channel has a signal of variance s² and noise of variance λs². The ratio λ of each channel is the likeliest of 41 values from 10⁻⁸ to 10². s²
/// is then the likeliest for this λ. The kernel length is common to all channels and maximises their joint likelihood. No samples are held out. With
/// a validation part, the deviations of each channel are then scaled so that 95 % of the errors lie within 1.96 deviations. Unscaled deviations are
/// too wide, because landmarks explain only part of the variance.
///
/// # Reference
/// C. E. Rasmussen, C. K. I. Williams, Gaussian Processes for Machine Learning, MIT Press 2006, eqs. 5.8 and 8.14, 8.15.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GaussianProcess {
    kernel: Kernel,
    refit: bool,
}

impl GaussianProcess {
    /// Registry entry of the Gaussian process.
    pub const INFO: ModelInfo = ModelInfo {
        name: "gaussian-process",
        about: "a Gaussian process on landmarks: predicts the uncertainty of every prediction",
        settings: Kernel::SETTINGS,
        features: Some(FeatureSpec::DEFAULT),
        make: |settings| Ok(Box::new(GaussianProcess::from_settings(settings)?)),
        load: KernelRegressor::load,
    };

    /// Builds the estimator from `settings`.
    ///
    /// # Errors
    /// [`SettingError`] for an unknown key or a value out of range.
    pub fn from_settings(settings: &ModelSettings) -> Result<GaussianProcess, SettingError> {
        settings.check_keys(GaussianProcess::INFO.settings)?;
        Ok(GaussianProcess {
            kernel: Kernel::from_settings(settings)?,
            refit: settings.refit()?,
        })
    }
}

/// Gaussian process fitted with one kernel length.
struct Fit {
    cost: f64,
    mapped: Mapped,
    linear: LinearRegressor,
    uncertainty: Uncertainty,
}

impl Fit {
    /// Root mean square error of each channel on the validation part, and a factor for the channel's predictive deviations. 95 % of the errors lie
    /// within 1.96 deviations times this factor.
    fn validated(
        &self,
        problem: &Problem<'_>,
        part: &Validation<'_>,
    ) -> Result<(Vec<Option<f64>>, Vec<f64>), ModelError> {
        let mapped = self.mapped.map.of(part.features);
        let (samples, channels) = (part.labels.nrows(), problem.channels());
        let mut found = vec![0.0; samples * channels];
        self.linear.predict(&mapped, &mut found)?;
        let mut deviations = vec![0.0; found.len()];
        for (sample, into) in deviations.chunks_exact_mut(channels).enumerate() {
            self.uncertainty.write(mapped.sample(sample), into);
        }
        let reach_of = |channel: usize| {
            let residuals = problem.residuals_of(&found, part, channel);
            let own = deviations.iter().skip(channel).step_by(channels);
            reach(residuals.zip(own).map(|(miss, own)| miss / own).collect())
        };
        let reaches = (0..channels).map(reach_of).collect();
        Ok((problem.errors_of(&found, part), reaches))
    }
}

fn fit_length(
    problem: &Problem<'_>,
    mapped: Mapped,
    validation: Option<&Validation<'_>>,
    progress: &dyn Progress,
) -> Result<Fit, ModelError> {
    let (features, labels): (Cow<'_, Features>, _) =
        match validation.zip(mapped.validation.as_ref()) {
            Some((part, features)) => (
                Cow::Owned(joined(&mapped.training, features)),
                stacked(&problem.centred, &part.labels),
            ),
            None => (Cow::Borrowed(&mapped.training), problem.centred.clone()),
        };
    let (shift, labels) = centred(labels);
    let design = Design::new(&features, FeatureScale::None);
    let spectrum = Spectrum::new(&design, progress)?;
    let rotated = spectrum.rotate(labels.as_ref());
    let best = likeliest(&spectrum, &rotated, &labels);
    let eigenvalues = spectrum.eigenvalues();
    let coefficients = Mat::from_fn(eigenvalues.len(), best.len(), |row, channel| {
        rotated[(row, channel)] / (eigenvalues[row] + best[channel].ratio)
    });
    let weights = spectrum.weights(coefficients.as_ref());
    let mean: Vec<f64> = problem
        .mean
        .iter()
        .zip(&shift)
        .map(|(a, b)| a + b)
        .collect();
    let linear = LinearRegressor::from_mapped(problem, &design, &weights, &mean)?;
    let known = eigenvalues
        .iter()
        .filter(|value| **value > spectrum.noise())
        .count();
    let vectors = spectrum.leading_feature_vectors(known);
    let samples = labels.nrows() as f64;
    let spans = problem.scaling.span();
    let uncertainty = Uncertainty {
        centre: design.centre().to_vec(),
        vectors: (0..known)
            .flat_map(|column| vectors.col_as_slice(column).to_vec())
            .collect(),
        eigenvalues: eigenvalues.iter().rev().take(known).copied().collect(),
        ratio: best.iter().map(|best| best.ratio).collect(),
        signal: best
            .iter()
            .zip(spans)
            .map(|(best, span)| best.signal * span * span)
            .collect(),
        noise: best
            .iter()
            .map(|best| best.ratio * (1.0 + 1.0 / samples))
            .collect(),
    };
    drop(spectrum);
    Ok(Fit {
        cost: best.iter().map(|best| best.cost).sum(),
        mapped,
        linear,
        uncertainty,
    })
}

impl ModelEstimator for GaussianProcess {
    fn fit_model(
        &self,
        training: &TrainingSet<'_>,
        validation: Option<&TrainingSet<'_>>,
        progress: &dyn Progress,
    ) -> Result<ModelFit, ModelError> {
        let problem = Problem::new(*training)?;
        let held = problem.validation(validation)?;
        let landmarks = self.kernel.landmarks(training.features, progress)?;
        // Fits without the validation part, so that its errors are unbiased.
        let learn = |part: Option<&Validation<'_>>, lengths: &[f64]| {
            let mut best: Option<Fit> = None;
            for &length in lengths.iter().rev() {
                interrupted(progress)?;
                let mapped = Mapped::new(&landmarks, length, part.map(|part| part.features));
                let fit = fit_length(&problem, mapped, part, progress)?;
                if best.as_ref().is_none_or(|best| fit.cost < best.cost) {
                    best = Some(fit);
                }
            }
            Ok::<Fit, ModelError>(best.expect("there is a length to try"))
        };
        let first = learn(None, &self.kernel.lengths())?;
        let ratios = first.uncertainty.ratio.clone();
        let (errors, reaches) = match &held {
            Some(part) => first.validated(&problem, part)?,
            None => (
                vec![None; problem.channels()],
                vec![1.0; problem.channels()],
            ),
        };
        let refitted = self.refit && held.is_some();
        let fit = if refitted {
            learn(held.as_ref(), &[first.mapped.map.length])?
        } else {
            first
        };
        let edges = self::ratios();
        let channels = ratios
            .iter()
            .zip(errors)
            .map(|(&ratio, rmse)| ChannelChoice {
                value: Some(ratio),
                rmse,
                at_edge: ratio <= edges[0] || ratio >= edges[edges.len() - 1],
            });
        let shape = training.features.shape();
        let known = Some(fit.uncertainty.reaching(&reaches));
        let regressor = KernelRegressor::new(shape, fit.mapped.map, fit.linear, known);
        Ok(ModelFit {
            regressor: ModelRegressor::new(regressor),
            choice: Choice {
                by: ChosenBy::Likelihood,
                setting: Some("noise_ratio".to_owned()),
                channels: channels.collect(),
            },
            scaling: problem.scaling,
            refitted,
        })
    }
}

impl Problem<'_> {
    /// Root mean square error of each channel over the samples of `part`, in the unit of the channel. `found` has one row of predictions per sample.
    pub(crate) fn errors_of(&self, found: &[f64], part: &Validation<'_>) -> Vec<Option<f64>> {
        let channels = self.channels();
        let of = |channel: usize| {
            let span = self.scaling.span()[channel];
            let residuals = self.residuals_of(found, part, channel);
            let squares: f64 = residuals.map(|residual| (residual / span).powi(2)).sum();
            rmse(squares / part.labels.nrows() as f64, span)
        };
        (0..channels).map(of).collect()
    }

    /// Prediction minus label of `channel` for each sample of `part`, in the unit of the channel.
    fn residuals_of<'a>(
        &'a self,
        found: &'a [f64],
        part: &'a Validation<'_>,
        channel: usize,
    ) -> impl Iterator<Item = f64> + 'a {
        let span = self.scaling.span()[channel];
        let offset = self.scaling.minimum()[channel] + span * self.mean[channel];
        let labels = part.labels.col_as_slice(channel).iter();
        let found = found.iter().skip(channel).step_by(self.channels());
        labels
            .zip(found)
            .map(move |(label, found)| found - offset - span * label)
    }
}

estimator!(GaussianProcess, |_| GaussianProcess::INFO.name);
