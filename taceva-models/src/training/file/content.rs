//! A model file whose card and tensors were checked, and from which a row of the registry loads its model.

use taceva_core::{Channels, FeatureShape};

use super::error::FormatError;
use super::tensors::Tensors;
use crate::training::card::ModelCard;
use crate::training::components::ProjectedRegressor;
use crate::training::regressor::{FittedModel, ModelRegressor};

/// A model file that is being read.
pub(crate) struct Stored<'a> {
    pub(crate) tensors: Tensors<'a>,
    pub(crate) card: &'a ModelCard,
    pub(crate) channels: Channels,
}

/// Loads the model that a file holds.
pub(crate) type Load = fn(&Stored<'_>) -> Result<ModelRegressor, FormatError>;

impl Stored<'_> {
    /// The shape of what is seen.
    pub(crate) fn shape(&self) -> FeatureShape {
        self.card.features.shape()
    }

    /// The model that `load` makes of the tensors for features of a shape, behind the principal components of the file if it has any.
    ///
    /// # Errors
    /// [`FormatError`] of `load`, and of a tensor that belongs to neither.
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
