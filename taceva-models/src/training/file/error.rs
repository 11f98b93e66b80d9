//! Errors of model files.

use taceva_core::ModelError;
use taceva_files::seal::SealError;
use taceva_network::NetworkError;

use super::limits::{CARD, FILE_MAX, FORMAT, HEADER_MAX};

/// Error of reading a model file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FormatError {
    /// The file ends within the length field of the header.
    #[error("the file ends before its header")]
    Short,
    /// The model file is too large.
    #[error("{length} bytes, expected a model of at most {FILE_MAX}")]
    FileSize {
        /// Length of the file, in bytes.
        length: u64,
    },
    /// The header of the model file is too large.
    #[error("a header of {length} bytes, expected at most {HEADER_MAX}")]
    HeaderSize {
        /// Length of the header, in bytes.
        length: u64,
    },
    /// The file is not a valid safetensors file.
    #[error("not a complete safetensors file: {0}")]
    Container(#[from] safetensors::SafeTensorError),
    /// The safetensors file is valid, but has no model card.
    #[error("no `{CARD}` in the metadata: a safetensors file, but not a model of TacEva")]
    NoCard,
    /// The model card cannot be parsed.
    #[error("the card: {0}")]
    CardText(#[from] serde_json::Error),
    /// The model card contradicts itself or the tensors.
    #[error(
        "the card contradicts itself: feature sizes out of range, or choices for other channels than it lists"
    )]
    Card,
    /// The digest of the card and tensors does not match, because the file was changed.
    #[error("the model: {0}")]
    Seal(#[from] SealError),
    /// This TacEva does not support the format version.
    #[error("format {found}: this TacEva reads {FORMAT}, a newer TacEva may read both")]
    Version {
        /// Format version of the model file.
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
    /// This TacEva has no model of this name.
    #[error("fitted by `{model}`, which this TacEva does not have", model = taceva_core::shown(model))]
    NoModel {
        /// Name of the model.
        model: String,
    },
    /// A tensor of the model is missing in the file.
    #[error("the tensor `{name}` is missing")]
    Missing {
        /// Name of the missing tensor.
        name: &'static str,
    },
    /// The plugin of the model is missing.
    #[error(
        "fitted by `{key}` of the plugin `{id}`, which was not found", key = taceva_core::shown(key), id = taceva_core::shown(id)
    )]
    NoPlugin {
        /// Id of the plugin.
        id: String,
        /// Key of the plugin's estimator, which begins with the id of the plugin.
        key: String,
    },
    /// The program was built without the library that the model needs.
    #[error(
        "fitted by `{model}`: this program was built without the feature `{feature}`: build it with `--features {feature}`", model = taceva_core::shown(model), feature = taceva_core::shown(feature)
    )]
    NoLibrary {
        /// Name of the model in the card.
        model: String,
        /// Cargo feature of the library.
        feature: String,
    },
    /// The file has a tensor that the model does not use.
    #[error("unexpected tensor `{name}`", name = taceva_core::shown(name))]
    Unexpected {
        /// Name of the unused tensor.
        name: String,
    },
    /// A tensor differs from the type or shape that the model card requires.
    #[error("tensor `{name}` is {found}, the card states {expected}")]
    Tensor {
        /// Name of the differing tensor.
        name: &'static str,
        /// Type and shape of the tensor in the file.
        found: String,
        /// Type and shape that the model card requires.
        expected: String,
    },
    /// A network tensor has the wrong type of numbers.
    #[error("tensor `{name}` is {found}, expected F32 in a network", name = taceva_core::shown(name))]
    Type {
        /// Name of the network tensor.
        name: String,
        /// Type of the numbers in the file.
        found: String,
    },
    /// The tensors do not match the network that the model card describes.
    #[error("the network: {0}")]
    Network(#[from] NetworkError),
    /// Channels in the card or numbers in the tensors are invalid.
    #[error("{0}")]
    Content(#[from] ModelError),
}
