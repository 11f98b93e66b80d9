//! What a file holds, read back: every size, version, shape and number is checked.

use safetensors::tensor::{Dtype, SafeTensors};
use serde::Deserialize;
use taceva_core::{Channels, FeatureShape, InputInfo};
use taceva_network::{NamedTensor, Network, Picture};

use super::bytes::check_sizes;
use super::seal::check_seal;
use crate::estimators::discriminant::ClassRegressor;
use crate::estimators::kernel::KernelRegressor;
use crate::estimators::library::LibraryRegressor;
use crate::estimators::linear::LinearRegressor;
use crate::estimators::neighbours::NeighbourRegressor;
use crate::estimators::network::{EnsembleRegressor, NetworkCard, NetworkRegressor};
use crate::estimators::projected::ProjectedRegressor;
use crate::estimators::trees::TreeRegressor;
use crate::model::{Form, Model, ModelCard, channels_of, plugin_from};
use crate::models::Models;
use crate::training::file::error::FormatError;
use crate::training::file::limits::{CARD, FILE_MAX};
use crate::training::file::tensors::Tensors;
use crate::training::fit::ModelRegressor;

/// The part of a card that every version has.
#[derive(Deserialize)]
struct Version {
    format: String,
}

impl Models {
    /// The model that `bytes` of a file hold; one of a plugin is loaded by its plugin.
    ///
    /// # Errors
    /// [`FormatError`] if anything is other than [`to_bytes`](Model::to_bytes) writes it, of a newer major version, or of a plugin that is not
    /// among these models or refuses it.
    pub fn read(&self, bytes: &[u8]) -> Result<Model, FormatError> {
        check_sizes(bytes)?;
        let (_, header) = SafeTensors::read_metadata(bytes)?;
        let text = header
            .metadata()
            .as_ref()
            .and_then(|metadata| metadata.get(CARD))
            .ok_or(FormatError::NoCard)?;
        let version = serde_json::from_str::<Version>(text)?.format;
        check_version(&version)?;
        let opened = SafeTensors::deserialize(bytes)?;
        check_seal(text, &opened, &version)?;
        let card: ModelCard = serde_json::from_str(text)?;
        let channels = channels_of(&card)?;
        let margin = card.margin.unwrap_or(0.0);
        let labels = card.channels.iter().all(|channel| {
            channel.minimum.is_finite() && channel.span.is_finite() && channel.span > 0.0
        });
        if !card.features.is_valid()
            || !is_of_its_input(&card)
            || card.choice.channels.len() != channels.len()
            || !(0.0..=1e6).contains(&margin)
            || !labels
        {
            return Err(FormatError::Card);
        }
        let tensors = Tensors(opened);
        let regressor = match (&card.network, &card.plugin, card.form) {
            (None, None, None) if !card.ensemble.is_empty() => {
                let ready = ensemble_from(&tensors.0, &channels, &card)?;
                ModelRegressor::Ensemble(Box::new(ready))
            }
            _ if !card.ensemble.is_empty() => return Err(FormatError::Card),
            (None, None, None) => {
                let shape = card.features.shape();
                ModelRegressor::Linear(LinearRegressor::from_tensors(&tensors, channels, shape)?)
            }
            (None, None, Some(form)) => formed(self, &tensors, (channels, &card), form)?,
            (None, Some(plugin), None) => {
                ModelRegressor::Plugin(plugin_from(self, &tensors, (&channels, &card, plugin))?)
            }
            (Some(network), None, None) => {
                let found = named_tensors(&tensors.0)?;
                let ready = network_from(found, channels, &card, network)?;
                ModelRegressor::Network(Box::new(ready))
            }
            _ => return Err(FormatError::Card),
        };
        Ok(Model { card, regressor })
    }
}

/// Whether what a card says of frames or signals is all of one or the other.
fn is_of_its_input(card: &ModelCard) -> bool {
    match (card.input, &card.spread) {
        (InputInfo::Frame(_), None) => card.features.channels.is_none(),
        (InputInfo::Signals(info), Some(spread)) => {
            let is_divisor = |spread: &f64| spread.is_finite() && *spread > 0.0;
            card.features.of_signals(info) == card.features
                && spread.len() == info.channels as usize
                && spread.iter().all(is_divisor)
        }
        _ => false,
    }
}

/// The kernel, the neighbours, the trees or the model of a library that tensors hold, and the principal components before them.
fn formed(
    models: &Models,
    tensors: &Tensors<'_>,
    (channels, card): (Channels, &ModelCard),
    form: Form,
) -> Result<ModelRegressor, FormatError> {
    let shape = card.features.shape();
    let pca = match card.features.pca {
        None => None,
        Some(count) => Some(ProjectedRegressor::pca_from(
            tensors,
            shape,
            count as usize,
        )?),
    };
    let seen = pca
        .as_ref()
        .map_or(shape, |pca| FeatureShape::flat(pca.variance_ratio().len()));
    let regressor = match form {
        Form::Kernel { .. } => {
            let kernel = KernelRegressor::from_tensors(tensors, channels, seen)?;
            ModelRegressor::Kernel(Box::new(kernel))
        }
        Form::Neighbours { .. } => {
            let neighbours = NeighbourRegressor::from_tensors(tensors, channels, seen)?;
            ModelRegressor::Neighbours(Box::new(neighbours))
        }
        Form::Classes { .. } => {
            let classes = ClassRegressor::from_tensors(tensors, channels, seen)?;
            ModelRegressor::Classes(Box::new(classes))
        }
        Form::Trees { .. } => {
            let trees = TreeRegressor::from_tensors(tensors, channels, seen)?;
            ModelRegressor::Trees(Box::new(trees))
        }
        Form::Library => {
            let library = card.library.as_ref().ok_or(FormatError::Card)?;
            let model = models
                .library(&card.model)
                .ok_or_else(|| FormatError::NoLibrary {
                    model: card.model.clone(),
                    feature: library.feature.clone(),
                })?;
            let kind = (channels, seen);
            let fitted = LibraryRegressor::from_tensors(tensors, kind, (model.load, library))?;
            ModelRegressor::Library(Box::new(fitted))
        }
    };
    let regressor = match pca {
        None => regressor,
        Some(pca) => regressor.through(pca)?,
    };
    // Nothing but what was read: what it would write again is what there is.
    let known: Vec<String> = regressor
        .tensors()
        .into_iter()
        .map(|tensor| tensor.name)
        .collect();
    let known: Vec<&str> = known.iter().map(String::as_str).collect();
    tensors.only(&known)?;
    if Form::of(&regressor) == Some(form) {
        Ok(regressor)
    } else {
        Err(FormatError::Card)
    }
}

/// The networks that tensors hold, those of each under a name of its own.
fn ensemble_from(
    tensors: &SafeTensors<'_>,
    channels: &Channels,
    card: &ModelCard,
) -> Result<EnsembleRegressor, FormatError> {
    let mut found = named_tensors(tensors)?;
    let mut members = Vec::new();
    for (number, network) in card.ensemble.iter().enumerate() {
        let prefix = EnsembleRegressor::prefix(number);
        let (own, others): (Vec<_>, Vec<_>) = found
            .into_iter()
            .partition(|tensor| tensor.name.starts_with(&prefix));
        found = others;
        let own = own.into_iter().map(|tensor| NamedTensor {
            name: tensor.name[prefix.len()..].to_owned(),
            ..tensor
        });
        members.push(network_from(
            own.collect(),
            channels.clone(),
            card,
            network,
        )?);
    }
    match found.into_iter().next() {
        Some(tensor) => Err(FormatError::Unexpected { name: tensor.name }),
        None => Ok(EnsembleRegressor::new(members)?),
    }
}

/// The network that tensors hold.
fn network_from(
    found: Vec<NamedTensor>,
    channels: Channels,
    card: &ModelCard,
    network: &NetworkCard,
) -> Result<NetworkRegressor, FormatError> {
    let shape = card.features.shape();
    let Picture {
        height,
        width,
        channels: depth,
    } = network.architecture.input;
    if (FeatureShape {
        height,
        width,
        depth,
    }) != shape
        || card.features.pca.is_some()
    {
        return Err(FormatError::Card);
    }
    // A card may lie: nothing is made that the file could not fill.
    let parameters = network.architecture.parameters()?;
    if parameters as u64 > FILE_MAX / size_of::<f32>() as u64 {
        return Err(FormatError::Card);
    }
    let ready = Network::from_tensors(&network.architecture, found)?;
    Ok(NetworkRegressor::new(channels, network.clone(), ready)?)
}

/// All tensors, which must be of single precision.
fn named_tensors(tensors: &SafeTensors<'_>) -> Result<Vec<NamedTensor>, FormatError> {
    let found = tensors.tensors().into_iter().map(|(name, tensor)| {
        if tensor.dtype() != Dtype::F32 {
            return Err(FormatError::Type {
                name,
                found: format!("{:?}", tensor.dtype()),
            });
        }
        let (numbers, _) = tensor.data().as_chunks::<4>();
        Ok(NamedTensor {
            name,
            shape: tensor.shape().to_vec(),
            values: numbers
                .iter()
                .map(|bytes| f32::from_le_bytes(*bytes))
                .collect(),
        })
    });
    found.collect()
}

/// Any minor version of our major version can be read: it only adds.
fn check_version(found: &str) -> Result<(), FormatError> {
    let major = |version: &str| -> Option<u32> {
        let (major, minor) = version.split_once('.')?;
        minor.parse::<u32>().ok()?;
        major.parse().ok()
    };
    if major(found).is_some() && major(found) == major(ModelCard::FORMAT) {
        Ok(())
    } else {
        Err(FormatError::Version {
            found: found.to_owned(),
        })
    }
}
