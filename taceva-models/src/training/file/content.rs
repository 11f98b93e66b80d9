//! Content of a model file whose card and tensors were checked.

use taceva_core::{Channels, FeatureShape};

use super::error::FormatError;
use super::tensors::Tensors;
use crate::training::card::ModelCard;
use crate::training::components::ProjectedRegressor;
use crate::training::regressor::{FittedModel, ModelRegressor};

/// Content of a model file.
pub(crate) struct Stored<'a> {
    pub(crate) tensors: Tensors<'a>,
    pub(crate) card: &'a ModelCard,
    pub(crate) channels: Channels,
}

/// Function that loads a regressor from the content of a model file.
pub(crate) type Load = fn(&Stored<'_>) -> Result<ModelRegressor, FormatError>;

impl Stored<'_> {
    /// Shape of the features that the model reads.
    pub(crate) fn shape(&self) -> FeatureShape {
        self.card.features.shape()
    }

    /// Loads a regressor with `load`. If the file contains principal components, the regressor reads features projected onto them.
    ///
    /// # Errors
    /// [`FormatError`] of `load`, or for a tensor that belongs neither to the regressor nor to the components.
    pub(crate) fn on_components<M: FittedModel>(
        &self,
        load: impl FnOnce(&Tensors<'_>, Channels, FeatureShape) -> Result<M, FormatError>,
    ) -> Result<ModelRegressor, FormatError> {
        let count = self.card.features.pca;
        let pca = count
            .map(|count| ProjectedRegressor::pca_from(&self.tensors, self.shape(), count as usize));
        let pca = pca.transpose()?;
        let seen = pca.as_ref().map_or(self.shape(), |pca| {
            FeatureShape::flat(pca.variance_ratio().len())
        });
        let regressor = ModelRegressor::new(load(&self.tensors, self.channels.clone(), seen)?);
        let regressor = match pca {
            None => regressor,
            Some(pca) => regressor.through(pca)?,
        };
        let tensors = regressor.tensors();
        let known: Vec<&str> = tensors.iter().map(|tensor| tensor.name.as_str()).collect();
        self.tensors.only(&known)?;
        Ok(regressor)
    }
}
