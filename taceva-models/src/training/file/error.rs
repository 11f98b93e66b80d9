//! Why bytes are no model.

use taceva_core::ModelError;
use taceva_files::seal::SealError;
use taceva_network::NetworkError;

use super::limits::{CARD, FILE_MAX, FORMAT, HEADER_MAX};

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
    #[error("format {found}: this TacEva reads {FORMAT}, a newer one may read both")]
    Version {
        /// The version of the file.
        found: String,
    },
    /// A file of a format from before formats began at 1.0.
    #[error(
        "format {format} of TacEva {taceva} is no longer read: fit the model anew with `taceva fit RECORDING --model NAME --out FILE`", format = taceva_core::shown(format), taceva = taceva_core::shown(taceva)
    )]
    Earlier {
        /// The version of the format.
        format: String,
        /// The version of TacEva that wrote it.
        taceva: String,
    },
    /// A model that this TacEva does not have.
    #[error("fitted by `{model}`, which this TacEva does not have", model = taceva_core::shown(model))]
    NoModel {
        /// The model.
        model: String,
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
