//! Errors of model files.

use taceva_core::ModelError;
use taceva_files::seal::SealError;
use taceva_network::NetworkError;

use super::limits::{CARD, FILE_MAX, FORMAT, HEADER_MAX};

/// Error of reading a model file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FormatError {
    /// The file is shorter than the length field of its header.
    #[error("the file ends before its header")]
    Short,
    /// The file is too large.
    #[error("{length} bytes, expected a model of at most {FILE_MAX}")]
    FileSize {
        /// Length found, in bytes.
        length: u64,
    },
    /// The header is too large.
    #[error("a header of {length} bytes, expected at most {HEADER_MAX}")]
    HeaderSize {
        /// Length found, in bytes.
        length: u64,
    },
    /// The file is not a valid safetensors file.
    #[error("not a complete safetensors file: {0}")]
    Container(#[from] safetensors::SafeTensorError),
    /// The safetensors file contains no model.
    #[error("no `{CARD}` in the metadata: a safetensors file, but not a model of TacEva")]
    NoCard,
    /// The card cannot be parsed.
    #[error("the card: {0}")]
    CardText(#[from] serde_json::Error),
    /// The card is inconsistent.
    #[error(
        "the card contradicts itself: feature sizes out of range, or choices for other channels than it lists"
    )]
    Card,
    /// The seal does not match, because the file was changed.
    #[error("the model: {0}")]
    Seal(#[from] SealError),
    /// This TacEva does not support the format version.
    #[error("format {found}: this TacEva reads {FORMAT}, a newer TacEva may read both")]
    Version {
        /// Format version of the file.
        found: String,
    },
    /// The file has a format older than 1.0.
    #[error(
        "format {format} of TacEva {taceva} is no longer read: fit the model again with `taceva fit RECORDING --model NAME --out FILE`", format = taceva_core::shown(format), taceva = taceva_core::shown(taceva)
    )]
    Earlier {
        /// Format version of the file.
        format: String,
        /// Version of TacEva that wrote the file.
        taceva: String,
    },
    /// This TacEva does not include the model.
    #[error("fitted by `{model}`, which this TacEva does not have", model = taceva_core::shown(model))]
    NoModel {
        /// Name of the model.
        model: String,
    },
    /// A tensor is missing.
    #[error("the tensor `{name}` is missing")]
    Missing {
        /// Name of the tensor.
        name: &'static str,
    },
    /// The plugin of the model is missing.
    #[error(
        "fitted by `{key}` of the plugin `{id}`, which was not found", key = taceva_core::shown(key), id = taceva_core::shown(id)
    )]
    NoPlugin {
        /// Id of the plugin.
        id: String,
        /// Key of the plugin's estimator.
        key: String,
    },
    /// The program was built without the library of the model.
    #[error(
        "fitted by `{model}`: this program was built without the feature `{feature}`: build it with `--features {feature}`", model = taceva_core::shown(model), feature = taceva_core::shown(feature)
    )]
    NoLibrary {
        /// Name of the model.
        model: String,
        /// Cargo feature of the library.
        feature: String,
    },
    /// A tensor belongs to no part of the model.
    #[error("unexpected tensor `{name}`", name = taceva_core::shown(name))]
    Unexpected {
        /// Name of the tensor.
        name: String,
    },
    /// A tensor has another type or shape than the card requires.
    #[error("tensor `{name}` is {found}, the card states {expected}")]
    Tensor {
        /// Name of the tensor.
        name: &'static str,
        /// Type and shape found.
        found: String,
        /// Type and shape expected.
        expected: String,
    },
    /// A network tensor has the wrong type.
    #[error("tensor `{name}` is {found}, expected F32 in a network", name = taceva_core::shown(name))]
    Type {
        /// Name of the tensor.
        name: String,
        /// Type found.
        found: String,
    },
    /// The tensors do not match the network of the card.
    #[error("the network: {0}")]
    Network(#[from] NetworkError),
    /// Channels or numbers are invalid.
    #[error("{0}")]
    Content(#[from] ModelError),
}
