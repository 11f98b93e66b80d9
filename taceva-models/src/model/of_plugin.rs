//! The model of a plugin in a file: one tensor, the bytes of its maker.

use safetensors::tensor::Dtype;
use taceva_core::{Channels, Saved};

use super::card::ModelCard;
use crate::estimators::plugin::{PluginCard, PluginRegressor};
use crate::file::FormatError;
use crate::file::tensors::{Raw, Tensors};
use crate::models::Models;

/// The tensor of the bytes.
const PLUGIN: &str = "plugin";

/// The tensor of the model of a plugin.
pub(crate) fn plugin_tensor(plugin: &PluginRegressor) -> Raw {
    Raw {
        name: PLUGIN.to_owned(),
        kind: Dtype::U8,
        shape: vec![plugin.bytes().len()],
        bytes: plugin.bytes().to_vec(),
    }
}

/// The model that the tensor holds, loaded by its plugin.
pub(crate) fn plugin_from(
    models: &Models,
    tensors: &Tensors<'_>,
    (channels, card, plugin): (&Channels, &ModelCard, &PluginCard),
) -> Result<PluginRegressor, FormatError> {
    tensors.only(&[PLUGIN])?;
    let tensor = tensors.0.tensor(PLUGIN);
    let tensor = tensor.map_err(|_| FormatError::Missing { name: PLUGIN })?;
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
