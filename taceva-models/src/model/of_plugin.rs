//! The model of a plugin in a file: one tensor, the bytes of its maker.

use safetensors::tensor::Dtype;
use taceva_core::{Channels, Saved};

use super::card::ModelCard;
use crate::estimators::plugin::{PluginCard, PluginRegressor, TENSOR};
use crate::models::Models;
use crate::training::file::error::FormatError;
use crate::training::file::tensors::Tensors;

/// The model that the tensor holds, loaded by its plugin.
pub(crate) fn plugin_from(
    models: &Models,
    tensors: &Tensors<'_>,
    (channels, card, plugin): (&Channels, &ModelCard, &PluginCard),
) -> Result<PluginRegressor, FormatError> {
    tensors.only(&[TENSOR])?;
    let tensor = tensors.0.tensor(TENSOR);
    let tensor = tensor.map_err(|_| FormatError::Missing { name: TENSOR })?;
    if tensor.dtype() != Dtype::U8 || card.features.pca.is_some() || card.model != plugin.key {
        return Err(FormatError::Card);
    }
    let factory = models.offered(&plugin.key);
    let factory = factory.ok_or_else(|| FormatError::NoPlugin {
        id: plugin.id.clone(),
        key: plugin.key.clone(),
    })?;
    let saved = Saved::new(tensor.data(), channels, card.features.shape());
    Ok(PluginRegressor::load(&**factory, plugin, &saved)?)
}
