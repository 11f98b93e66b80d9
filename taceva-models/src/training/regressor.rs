//! A fitted model of any kind: predictions, and what a file keeps of it.

use std::any::Any;
use std::fmt;
use std::sync::Arc;

use taceva_core::{Channels, FeatureShape, Features, ModelError, Regressor};

use crate::features::Pca;
use crate::training::card::KindCard;
use crate::training::components::ProjectedRegressor;
use crate::training::file::tensors::Raw;

/// A regressor that a model file keeps.
pub(crate) trait FittedModel: Regressor + Any + fmt::Debug {
    /// The parts of the card that describe this kind of model; none of a linear one.
    fn kind(&self) -> KindCard {
        KindCard::default()
    }

    /// The tensors of a file.
    fn tensors(&self) -> Vec<Raw>;

    /// Whether predictions depend on what is seen.
    fn reads_features(&self) -> bool;

    /// Whether it knows the standard deviations of its predictions.
    fn knows_deviations(&self) -> bool {
        false
    }

    /// The standard deviation of every prediction, `[samples, channels]`; `None` for a model that does not know it.
    fn deviations(&self, _: &Features) -> Result<Option<Vec<f64>>, ModelError> {
        Ok(None)
    }

    /// The regressor of pixels into which the components of `pca` are folded; `None` if the components have to be kept beside the model.
    fn through(&self, _: &Pca) -> Result<Option<ModelRegressor>, ModelError> {
        Ok(None)
    }
}

/// A fitted model of a kind that a file can keep; copies share it.
#[derive(Clone)]
pub struct ModelRegressor(Arc<dyn FittedModel>);

impl ModelRegressor {
    pub(crate) fn new(model: impl FittedModel) -> ModelRegressor {
        ModelRegressor(Arc::new(model))
    }

    /// The regressor as a `T`; `None` if the model is of another kind.
    pub fn get<T: Regressor + 'static>(&self) -> Option<&T> {
        let own: &dyn Any = &*self.0;
        own.downcast_ref()
    }

    /// The regressor of pixels that equals `self` on the components of `pca`.
    ///
    /// # Errors
    /// [`ModelError`] for a network, which reads pictures, and for a plugin's, whose weights are not accessible.
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

    /// Whether predictions depend on what is seen: a linear model without weights needs no frame.
    pub(crate) fn reads_features(&self) -> bool {
        self.0.reads_features()
    }

    /// Whether it knows the standard deviations of its predictions.
    pub fn knows_deviations(&self) -> bool {
        self.0.knows_deviations()
    }

    /// The standard deviation of every prediction; `None` for a model that does not know it.
    ///
    /// # Shapes
    /// `[samples, channels]`.
    /// # Units
    /// Those of the channels.
    /// # Errors
    /// [`ModelError`] if the features are of another shape.
    pub fn deviations(&self, features: &Features) -> Result<Option<Vec<f64>>, ModelError> {
        self.0.deviations(features)
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

/// Models of which a file keeps the same are the same.
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
