//! Fitted models of any kind: predictions and stored tensors.

use std::any::Any;
use std::fmt;
use std::sync::Arc;

use taceva_core::{Channels, FeatureShape, Features, ModelError, Regressor};

use crate::features::Pca;
use crate::training::card::KindCard;
use crate::training::components::ProjectedRegressor;
use crate::training::file::tensors::Raw;

/// A regressor that can be stored in a model file.
pub(crate) trait FittedModel: Regressor + Any + fmt::Debug {
    /// Entries of the model card that depend on the kind of model; empty for a linear model.
    fn kind(&self) -> KindCard {
        KindCard::default()
    }

    /// Tensors to store in a file.
    fn tensors(&self) -> Vec<Raw>;

    /// True if predictions depend on features.
    fn reads_features(&self) -> bool;

    /// True if the model estimates the standard deviation of each prediction.
    fn knows_deviations(&self) -> bool {
        false
    }

    /// Standard deviation of every prediction, shape `[samples, channels]`; `None` if the model does not estimate deviations.
    fn deviations(&self, _: &Features) -> Result<Option<Vec<f64>>, ModelError> {
        Ok(None)
    }

    /// Probability of each class for each sample; `None` if the model does not estimate probabilities.
    fn probabilities(&self, _: &Features) -> Result<Option<ClassProbabilities>, ModelError> {
        Ok(None)
    }

    /// Converts this regressor, which reads principal components, to an equal regressor that reads the features before `pca`. `None` if such a
    /// regressor must store the components.
    fn through(&self, _: &Pca) -> Result<Option<ModelRegressor>, ModelError> {
        Ok(None)
    }
}

/// Probability of each class for each sample, from a classifier with a single channel.
///
/// ```
/// use taceva_models::ClassProbabilities;
/// let of_two_samples = ClassProbabilities { labels: vec![0.0, 1.0], shares: vec![0.9, 0.1, 0.2, 0.8] };
/// let second: Vec<&[f64]> = of_two_samples.samples().collect();
/// assert_eq!(second[1], [0.2, 0.8]);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ClassProbabilities {
    /// Label of each class, ascending.
    pub labels: Vec<f64>,
    /// Probabilities, shape `[samples, classes]`.
    pub shares: Vec<f64>,
}

impl ClassProbabilities {
    /// Probabilities of each sample, in the order of `labels`.
    pub fn samples(&self) -> impl Iterator<Item = &[f64]> {
        self.shares.chunks_exact(self.labels.len().max(1))
    }
}

/// Fitted model that can be stored in a file. Clones share the same data in memory.
#[derive(Clone)]
pub struct ModelRegressor(Arc<dyn FittedModel>);

impl ModelRegressor {
    pub(crate) fn new(model: impl FittedModel) -> ModelRegressor {
        ModelRegressor(Arc::new(model))
    }

    /// Returns the model if its type is `T`; `None` for another type.
    pub fn get<T: Regressor + 'static>(&self) -> Option<&T> {
        let own: &dyn Any = &*self.0;
        own.downcast_ref()
    }

    /// Converts a regressor that reads principal components to an equal regressor that reads the features before `pca`.
    ///
    /// # Errors
    /// [`ModelError`] for a network, which reads pictures, and for a plugin model, whose weights are not accessible.
    pub(crate) fn through(self, pca: Pca) -> Result<ModelRegressor, ModelError> {
        let folded = self.0.through(&pca)?;
        Ok(folded.unwrap_or_else(|| ModelRegressor::new(ProjectedRegressor::new(pca, self))))
    }

    pub(crate) fn kind(&self) -> KindCard {
        self.0.kind()
    }

    pub(crate) fn tensors(&self) -> Vec<Raw> {
        self.0.tensors()
    }

    /// True if predictions depend on features. False for a linear model whose weights are all 0, which needs no frames.
    pub(crate) fn reads_features(&self) -> bool {
        self.0.reads_features()
    }

    /// True if the model estimates the standard deviation of each prediction.
    pub fn knows_deviations(&self) -> bool {
        self.0.knows_deviations()
    }

    /// Standard deviation of every prediction; `None` if the model does not estimate deviations.
    ///
    /// # Shapes
    /// Returns `[samples, channels]`.
    /// # Units
    /// Deviations have the units of the channels.
    /// # Errors
    /// [`ModelError`] if the features do not have the shape that the model reads.
    pub fn deviations(&self, features: &Features) -> Result<Option<Vec<f64>>, ModelError> {
        self.0.deviations(features)
    }

    /// Probability of each class for each sample; `None` if the model is not a classifier that estimates probabilities.
    ///
    /// # Errors
    /// [`ModelError`] if the features do not have the shape that the model reads.
    pub fn probabilities(
        &self,
        features: &Features,
    ) -> Result<Option<ClassProbabilities>, ModelError> {
        self.0.probabilities(features)
    }
}

impl Regressor for ModelRegressor {
    fn channels(&self) -> &Channels {
        self.0.channels()
    }

    fn shape(&self) -> FeatureShape {
        self.0.shape()
    }

    fn predict(&self, features: &Features, into: &mut [f64]) -> Result<(), ModelError> {
        self.0.predict(features, into)
    }
}

/// Compares the kind, channels, feature shape and stored tensors of two models.
impl PartialEq for ModelRegressor {
    fn eq(&self, other: &ModelRegressor) -> bool {
        self.kind() == other.kind()
            && self.channels() == other.channels()
            && self.shape() == other.shape()
            && self.tensors() == other.tensors()
    }
}

impl fmt::Debug for ModelRegressor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}
