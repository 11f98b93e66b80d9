//! Linear regressors, the fitted models of baseline, ridge, partial least squares and elastic net.

use faer::Mat;
use rayon::prelude::*;
use taceva_core::{
    Channels, ErrorKind, Estimator, FeatureShape, Features, ModelError, Progress, Regressor,
    TrainingSet,
};

use crate::features::Pca;
use crate::linalg::{Design, dot, invalid};
use crate::training::choice::Choice;
use crate::training::file::content::Stored;
use crate::training::file::error::FormatError;
use crate::training::file::tensors::Raw;
use crate::training::fit::{ModelEstimator, ModelFit};
use crate::training::label_scaling::LabelScaling;
use crate::training::output::{check_call, check_finite};
use crate::training::problem::Problem;
use crate::training::regressor::{FittedModel, ModelRegressor};

/// Estimator that fits a linear regressor and reports how its settings were chosen.
pub trait LinearEstimator: Estimator {
    /// Fits a linear regressor with the same rules as [`Estimator::fit`].
    ///
    /// # Errors
    /// Errors of [`Estimator::fit`].
    fn fit_linear(
        &self,
        training: &TrainingSet<'_>,
        validation: Option<&TrainingSet<'_>>,
        progress: &dyn Progress,
    ) -> Result<LinearFit, ModelError>;
}

/// Result of fitting a linear estimator.
#[derive(Clone, Debug)]
pub struct LinearFit {
    /// Fitted model, in the units of the channels.
    pub regressor: LinearRegressor,
    /// Chosen setting and root mean square error of each channel.
    pub choice: Choice,
    /// Least label and range of labels of each channel in the training part.
    pub scaling: LabelScaling,
    /// True if the model was refitted on training and validation parts with the chosen settings.
    pub refitted: bool,
}

/// Predicts each channel as bias + Σ weight · feature.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearRegressor {
    channels: Channels,
    shape: FeatureShape,
    weights: Vec<f64>,
    bias: Vec<f64>,
}

/// Name of the tensor that stores the biases.
const BIAS: &str = "bias";
const WEIGHTS: &str = "weights";

/// Number of samples per task of a thread.
const CHUNK: usize = 64;

impl LinearRegressor {
    /// Builds a regressor from weights and biases.
    ///
    /// # Shapes
    /// `weights`: `[channels, features]`; `bias`: `[channels]`.
    ///
    /// # Units
    /// Units of the channels.
    /// # Errors
    /// [`ModelError`] if a length differs or a value is not finite.
    pub fn new(
        channels: Channels,
        shape: FeatureShape,
        weights: Vec<f64>,
        bias: Vec<f64>,
    ) -> Result<LinearRegressor, ModelError> {
        let expected = channels.len().checked_mul(shape.len());
        if Some(weights.len()) != expected || bias.len() != channels.len() {
            return Err(invalid(format!(
                "{} weights and {} biases for {} channels of {} features, expected a weight for each channel and feature, and a bias for each channel",
                weights.len(),
                bias.len(),
                channels.len(),
                shape.len()
            )));
        }
        if !weights.iter().chain(&bias).all(|value| value.is_finite()) {
            return Err(ModelError::new(
                ErrorKind::OutOfRange,
                "a weight is not finite",
            ));
        }
        Ok(LinearRegressor {
            channels,
            shape,
            weights,
            bias,
        })
    }

    /// Builds a regressor that predicts in the units of the channels. `weights` are for the centred features of `design`, and `mean` is the mean of
    /// the scaled labels.
    pub(crate) fn from_scaled(
        problem: &Problem<'_>,
        design: &Design<'_>,
        weights: &Mat<f64>,
        mean: &[f64],
    ) -> Result<LinearRegressor, ModelError> {
        let shape = problem.training.features.shape();
        LinearRegressor::of_design(problem, shape, design, weights, mean)
    }

    /// Like [`from_scaled`](Self::from_scaled), but for features that were computed from other features, such as Nyström features.
    pub(crate) fn from_mapped(
        problem: &Problem<'_>,
        design: &Design<'_>,
        weights: &Mat<f64>,
        mean: &[f64],
    ) -> Result<LinearRegressor, ModelError> {
        let shape = FeatureShape::flat(design.width());
        LinearRegressor::of_design(problem, shape, design, weights, mean)
    }

    fn of_design(
        problem: &Problem<'_>,
        shape: FeatureShape,
        design: &Design<'_>,
        weights: &Mat<f64>,
        mean: &[f64],
    ) -> Result<LinearRegressor, ModelError> {
        let mut flat = Vec::with_capacity(weights.nrows() * weights.ncols());
        let mut bias = Vec::with_capacity(mean.len());
        for (channel, mean) in mean.iter().enumerate() {
            let (minimum, span) = (
                problem.scaling.minimum()[channel],
                problem.scaling.span()[channel],
            );
            let start = flat.len();
            flat.extend(
                weights
                    .col_as_slice(channel)
                    .iter()
                    .map(|weight| weight * span),
            );
            if let Some(factor) = design.factor() {
                let places = flat[start..].iter_mut().zip(factor);
                places.for_each(|(weight, factor)| *weight *= factor);
            }
            let at_centre: f64 = flat[start..]
                .iter()
                .zip(design.centre())
                .map(|(weight, centre)| weight * centre)
                .sum();
            bias.push(minimum + span * mean - at_centre);
        }
        LinearRegressor::new(problem.training.targets.channels.clone(), shape, flat, bias)
    }

    /// Loads the model from a file.
    pub(crate) fn load(stored: &Stored<'_>) -> Result<ModelRegressor, FormatError> {
        let (tensors, channels) = (&stored.tensors, stored.channels.clone());
        let shape = stored.shape();
        tensors.only(&[BIAS, WEIGHTS])?;
        let bias = tensors.doubles(BIAS, &[channels.len()])?;
        let weights = tensors.doubles(WEIGHTS, &[channels.len(), shape.len()])?;
        let own = LinearRegressor::new(channels, shape, weights, bias)?;
        Ok(ModelRegressor::new(own))
    }

    /// Weights of each channel: unit of the channel per unit of the feature.
    ///
    /// # Shapes
    /// `[channels, features]`.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// Prediction of each channel if all features are 0, in the unit of the channel.
    pub fn bias(&self) -> &[f64] {
        &self.bias
    }

    /// Predicts one sample.
    ///
    /// # Shapes
    /// `sample`: `[features]`; `into`: `[channels]`, allocated by the caller.
    /// # Errors
    /// [`ModelError`] if a shape differs, or a prediction is not finite.
    pub fn predict_one(&self, sample: &[f32], into: &mut [f64]) -> Result<(), ModelError> {
        if sample.len() != self.shape.len() || into.len() != self.channels.len() {
            return Err(invalid(format!(
                "a sample of {} features and a buffer of {} predictions, expected {} and {}",
                sample.len(),
                into.len(),
                self.shape.len(),
                self.channels.len()
            )));
        }
        self.write(sample, into);
        match into.iter().position(|value| !value.is_finite()) {
            None => Ok(()),
            Some(channel) => Err(ModelError::new(
                ErrorKind::OutOfRange,
                format!(
                    "the prediction of `{}` is not finite",
                    self.channels.as_slice()[channel]
                ),
            )),
        }
    }

    pub(crate) fn write(&self, sample: &[f32], into: &mut [f64]) {
        let rows = self.weights.chunks_exact(sample.len().max(1));
        for ((place, row), bias) in into.iter_mut().zip(rows).zip(&self.bias) {
            *place = bias + dot(row, sample);
        }
    }
}

impl FittedModel for LinearRegressor {
    fn tensors(&self) -> Vec<Raw> {
        let (channels, features) = (self.channels.len(), self.shape.len());
        vec![
            Raw::doubles(BIAS, vec![channels], &self.bias),
            Raw::doubles(WEIGHTS, vec![channels, features], &self.weights),
        ]
    }

    fn reads_features(&self) -> bool {
        self.weights.iter().any(|weight| weight.abs() > 0.0)
    }

    fn through(&self, pca: &Pca) -> Result<Option<ModelRegressor>, ModelError> {
        let components = self.shape.len();
        let mut weights = vec![0.0; self.channels.len() * pca.mean().len()];
        let mut bias = self.bias.clone();
        let rows = weights.chunks_exact_mut(pca.mean().len());
        for ((row, bias), own) in rows
            .zip(&mut bias)
            .zip(self.weights.chunks_exact(components))
        {
            for (weight, component) in own.iter().zip(pca.components()) {
                let places = row.iter_mut().zip(component);
                places.for_each(|(place, value)| *place += weight * value);
            }
            let at_mean: f64 = row
                .iter()
                .zip(pca.mean())
                .map(|(weight, mean)| weight * mean)
                .sum();
            *bias -= at_mean;
        }
        let own = LinearRegressor::new(self.channels.clone(), pca.shape(), weights, bias)?;
        Ok(Some(ModelRegressor::new(own)))
    }
}

impl<L: LinearEstimator> ModelEstimator for L {
    fn fit_model(
        &self,
        training: &TrainingSet<'_>,
        validation: Option<&TrainingSet<'_>>,
        progress: &dyn Progress,
    ) -> Result<ModelFit, ModelError> {
        let fit = self.fit_linear(training, validation, progress)?;
        Ok(ModelFit {
            regressor: ModelRegressor::new(fit.regressor),
            choice: fit.choice,
            scaling: fit.scaling,
            refitted: fit.refitted,
        })
    }
}

impl Regressor for LinearRegressor {
    fn channels(&self) -> &Channels {
        &self.channels
    }

    fn shape(&self) -> FeatureShape {
        self.shape
    }

    fn predict(&self, features: &Features, into: &mut [f64]) -> Result<(), ModelError> {
        let channels = self.channels.len();
        check_call(&self.channels, self.shape, features, into)?;
        into.par_chunks_mut(CHUNK * channels)
            .zip(features.values().par_chunks(CHUNK * self.shape.len()))
            .for_each(|(into, samples)| {
                let samples = samples.chunks_exact(self.shape.len());
                for (into, sample) in into.chunks_exact_mut(channels).zip(samples) {
                    self.write(sample, into);
                }
            });
        check_finite(&self.channels, into)
    }
}
