//! A model as bytes: a safetensors file whose metadata holds the card.

use std::collections::HashMap;

use safetensors::tensor::{Dtype, SafeTensors, TensorView};
use serde::Deserialize;
use sha2::{Digest as _, Sha256};

use super::card::{Form, ModelCard};
use super::of_plugin::plugin_from;
use super::{Model, channels_of};
use crate::discriminant::ClassRegressor;
use crate::fit::ModelRegressor;
use crate::kernel::KernelRegressor;
use crate::library::LibraryRegressor;
use crate::linear::LinearRegressor;
use crate::models::Models;
use crate::neighbours::NeighbourRegressor;
use crate::network::{NetworkCard, NetworkRegressor};
use crate::projected::ProjectedRegressor;
use crate::tensors::Tensors;
use crate::trees::TreeRegressor;
use taceva_core::{Channels, FeatureShape, ModelError};
use taceva_network::{NamedTensor, Network, NetworkError, Picture};
use taceva_seal::SealError;

/// The key of the card in the metadata.
const CARD: &str = "taceva.model";

/// Longest header: a card is a few kilobytes.
const HEADER_MAX: u64 = 1 << 20;

/// Largest file: 1000 × 1000 RGB weights of ten channels are 240 MB.
pub(super) const FILE_MAX: u64 = 1 << 28;

/// The part of a card that every version has.
#[derive(Deserialize)]
struct Version {
    format: String,
}

impl Model {
    /// The model as a file would hold it; equal models give equal bytes.
    ///
    /// # Errors
    /// [`FormatError`] if the card or the weights are larger than a file may be.
    pub fn to_bytes(&self) -> Result<Vec<u8>, FormatError> {
        let card = serde_json::to_string(&self.card)?;
        let tensors = self.regressor.tensors();
        let card = match is_sealed(&self.card.format) {
            true => {
                let told = tensors
                    .iter()
                    .map(|tensor| told(&tensor.name, tensor.kind, (&tensor.shape, &tensor.bytes)));
                seal_over(&card, &told.collect::<Vec<_>>())?
            }
            false => card,
        };
        // One key only: the order of several would not be defined.
        let metadata = HashMap::from([(CARD.to_owned(), card)]);
        let views: Result<Vec<_>, _> = tensors
            .iter()
            .map(|tensor| {
                let view = TensorView::new(tensor.kind, tensor.shape.clone(), &tensor.bytes);
                view.map(|view| (tensor.name.as_str(), view))
            })
            .collect();
        let bytes = safetensors::serialize(views?, Some(metadata))?;
        check_sizes(&bytes)?;
        Ok(bytes)
    }

    /// The model that `bytes` of a file hold, of those that are built in.
    ///
    /// # Errors
    /// As [`Models::read`].
    pub fn from_bytes(bytes: &[u8]) -> Result<Model, FormatError> {
        Models::builtin().read(bytes)
    }
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
            || card.choice.channels.len() != channels.len()
            || !(0.0..=1e6).contains(&margin)
            || !labels
        {
            return Err(FormatError::Card);
        }
        let tensors = Tensors(opened);
        let regressor = match (&card.network, &card.plugin, card.form) {
            (None, None, None) => {
                let shape = card.features.shape();
                ModelRegressor::Linear(LinearRegressor::from_tensors(&tensors, channels, shape)?)
            }
            (None, None, Some(form)) => formed(self, &tensors, (channels, &card), form)?,
            (None, Some(plugin), None) => {
                ModelRegressor::Plugin(plugin_from(self, &tensors, (&channels, &card, plugin))?)
            }
            (Some(network), None, None) => {
                let ready = network_from(&tensors.0, channels, &card, network)?;
                ModelRegressor::Network(Box::new(ready))
            }
            _ => return Err(FormatError::Card),
        };
        Ok(Model { card, regressor })
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
            let fitted = LibraryRegressor::from_tensors(tensors, kind, (model, library))?;
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

/// The network that tensors hold.
fn network_from(
    tensors: &SafeTensors<'_>,
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
    let found: Vec<NamedTensor> = found.collect::<Result<_, FormatError>>()?;
    let ready = Network::from_tensors(&network.architecture, found)?;
    Ok(NetworkRegressor::new(channels, network.clone(), ready)?)
}

/// A tensor's name, and a digest of its type, its shape and its numbers.
fn told(name: &str, kind: Dtype, (shape, bytes): (&[usize], &[u8])) -> (String, Vec<u8>) {
    let mut hasher = Sha256::new();
    hasher.update(format!("{kind:?} {shape:?} ").as_bytes());
    hasher.update(bytes);
    (format!("tensor {name}"), hasher.finalize().to_vec())
}

/// The card with its seal, over the tensors as well.
fn seal_over(card: &str, told: &[(String, Vec<u8>)]) -> Result<String, FormatError> {
    let mut attached = attached(told);
    attached.sort_unstable();
    Ok(taceva_seal::json::seal_with(card, &attached)?)
}

fn attached(told: &[(String, Vec<u8>)]) -> Vec<(&str, &[u8])> {
    told.iter()
        .map(|(name, digest)| (name.as_str(), digest.as_slice()))
        .collect()
}

/// Whether card and tensors are what they were when they were written.
fn check_seal(card: &str, tensors: &SafeTensors<'_>, version: &str) -> Result<(), FormatError> {
    let views = tensors.tensors();
    let told: Vec<_> = views
        .iter()
        .map(|(name, view)| told(name, view.dtype(), (view.shape(), view.data())))
        .collect();
    let mut attached = attached(&told);
    attached.sort_unstable();
    let version = match is_sealed(version) {
        true => taceva_seal::Version::Sealed,
        false => taceva_seal::Version::BeforeSeals,
    };
    taceva_seal::json::check_with(card, &attached, version)?;
    Ok(())
}

/// Whether files of this version are sealed: all since 1.1.
pub(super) fn is_sealed(version: &str) -> bool {
    let minor = version
        .split_once('.')
        .and_then(|(_, minor)| minor.parse().ok());
    minor.is_some_and(|minor: u32| minor >= 1)
}

fn check_sizes(bytes: &[u8]) -> Result<(), FormatError> {
    let length = bytes.len() as u64;
    if length > FILE_MAX {
        return Err(FormatError::FileSize { length });
    }
    let length = bytes.first_chunk::<8>().ok_or(FormatError::Short)?;
    let length = u64::from_le_bytes(*length);
    if length > HEADER_MAX {
        return Err(FormatError::HeaderSize { length });
    }
    Ok(())
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

/// Why bytes are no model.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FormatError {
    /// Fewer bytes than the length of the header takes.
    #[error("the file ends before its header")]
    Short,
    /// A file beyond what a model takes.
    #[error("{length} bytes, a model has at most {FILE_MAX}")]
    FileSize {
        /// Its length.
        length: u64,
    },
    /// A header beyond what a card takes.
    #[error("a header of {length} bytes, a model has at most {HEADER_MAX}")]
    HeaderSize {
        /// Its length.
        length: u64,
    },
    /// Not a safetensors file, or a damaged one.
    #[error("not a whole safetensors file: {0}")]
    Container(#[from] safetensors::SafeTensorError),
    /// A safetensors file of something else.
    #[error("the metadata lack `{CARD}`: a safetensors file, but no model of TacEva")]
    NoCard,
    /// A card that cannot be read.
    #[error("the card: {0}")]
    CardText(#[from] serde_json::Error),
    /// A card that contradicts itself.
    #[error(
        "the card contradicts itself: feature sizes out of range, or choices for other channels than it lists"
    )]
    Card,
    /// A model that is not what it was when it was written.
    #[error("the model: {0}")]
    Seal(#[from] SealError),
    /// A version this TacEva cannot read.
    #[error(
        "format {found}: this TacEva reads {}, a newer one may read both",
        ModelCard::FORMAT
    )]
    Version {
        /// The version of the file.
        found: String,
    },
    /// A tensor that is not there.
    #[error("no tensor `{name}`")]
    Missing {
        /// Its name.
        name: &'static str,
    },
    /// A model of a plugin that is not there.
    #[error(
        "fitted by `{key}` of the plugin `{id}`, which is not among the plugins that were found", key = taceva_core::shown(key), id = taceva_core::shown(id)
    )]
    NoPlugin {
        /// The plugin.
        id: String,
        /// The estimator in it.
        key: String,
    },
    /// A model of a library that this program was built without.
    #[error(
        "fitted by `{model}`: this program was built without the feature `{feature}`: build it with `--features {feature}`", model = taceva_core::shown(model), feature = taceva_core::shown(feature)
    )]
    NoLibrary {
        /// The model.
        model: String,
        /// The feature that offers it.
        feature: String,
    },
    /// A tensor that does not belong there.
    #[error("unexpected tensor `{name}`", name = taceva_core::shown(name))]
    Unexpected {
        /// Its name.
        name: String,
    },
    /// A tensor of another type or shape than the card says.
    #[error("tensor `{name}` is {found}, the card says {expected}")]
    Tensor {
        /// Its name.
        name: &'static str,
        /// Type and shape found.
        found: String,
        /// Type and shape expected.
        expected: String,
    },
    /// A tensor of a network of another type than all have.
    #[error("tensor `{name}` is {found}, those of a network are F32", name = taceva_core::shown(name))]
    Type {
        /// Its name.
        name: String,
        /// The type found.
        found: String,
    },
    /// Tensors that are not those of the network that the card names.
    #[error("the network: {0}")]
    Network(#[from] NetworkError),
    /// Channels or numbers that no model has.
    #[error("{0}")]
    Content(#[from] ModelError),
}
