//! A model as bytes: a safetensors file whose metadata holds the card.

use std::collections::HashMap;

use safetensors::tensor::{Dtype, SafeTensors, TensorView};
use serde::Deserialize;

use super::card::ModelCard;
use super::{Model, channels_of};
use crate::linear::LinearRegressor;
use taceva_core::ModelError;

/// The key of the card in the metadata.
const CARD: &str = "taceva.model";

/// The tensors of a model, in the order of their names.
const BIAS: &str = "bias";
const WEIGHTS: &str = "weights";

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
        let little_endian = |values: &[f64]| -> Vec<u8> {
            values
                .iter()
                .flat_map(|value| value.to_le_bytes())
                .collect()
        };
        let weights = little_endian(self.regressor.weights());
        let bias = little_endian(self.regressor.bias());
        let channels = self.regressor.bias().len();
        let features = self.card.features.shape().len();
        let view =
            |name, shape, data| TensorView::new(Dtype::F64, shape, data).map(|view| (name, view));
        let tensors = [
            view(BIAS, vec![channels], &bias)?,
            view(WEIGHTS, vec![channels, features], &weights)?,
        ];
        let card = serde_json::to_string(&self.card)?;
        // One key only: the order of several would not be defined.
        let metadata = HashMap::from([(CARD.to_owned(), card)]);
        let bytes = safetensors::serialize(tensors, Some(metadata))?;
        check_sizes(&bytes)?;
        Ok(bytes)
    }

    /// The model that `bytes` of a file hold.
    ///
    /// # Errors
    /// [`FormatError`] if anything is other than [`to_bytes`](Model::to_bytes) writes it, or of a newer major version.
    pub fn from_bytes(bytes: &[u8]) -> Result<Model, FormatError> {
        check_sizes(bytes)?;
        let (_, header) = SafeTensors::read_metadata(bytes)?;
        let text = header
            .metadata()
            .as_ref()
            .and_then(|metadata| metadata.get(CARD))
            .ok_or(FormatError::NoCard)?;
        check_version(&serde_json::from_str::<Version>(text)?.format)?;
        let card: ModelCard = serde_json::from_str(text)?;
        let channels = channels_of(&card)?;
        if !card.features.is_valid() || card.choice.channels.len() != channels.len() {
            return Err(FormatError::Card);
        }
        let tensors = SafeTensors::deserialize(bytes)?;
        let known = [BIAS, WEIGHTS];
        if let Some(name) = tensors
            .names()
            .into_iter()
            .find(|name| !known.contains(name))
        {
            return Err(FormatError::Unexpected {
                name: name.to_owned(),
            });
        }
        let shape = card.features.shape();
        let bias = numbers(&tensors, BIAS, &[channels.len()])?;
        let weights = numbers(&tensors, WEIGHTS, &[channels.len(), shape.len()])?;
        let regressor = LinearRegressor::new(channels, shape, weights, bias)?;
        Ok(Model { card, regressor })
    }
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

fn numbers(
    tensors: &SafeTensors<'_>,
    name: &'static str,
    shape: &[usize],
) -> Result<Vec<f64>, FormatError> {
    let tensor = tensors
        .tensor(name)
        .map_err(|_| FormatError::Missing { name })?;
    if tensor.dtype() != Dtype::F64 || tensor.shape() != shape {
        return Err(FormatError::Tensor {
            name,
            found: format!("{:?} {:?}", tensor.dtype(), tensor.shape()),
            expected: format!("F64 {shape:?}"),
        });
    }
    let (numbers, _) = tensor.data().as_chunks::<8>();
    Ok(numbers
        .iter()
        .map(|bytes| f64::from_le_bytes(*bytes))
        .collect())
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
    /// A tensor that does not belong there.
    #[error("unexpected tensor `{name}`")]
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
    /// Channels or numbers that no model has.
    #[error("{0}")]
    Content(#[from] ModelError),
}
