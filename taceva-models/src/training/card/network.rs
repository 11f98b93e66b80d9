//! Network settings in a model card.

use serde::{Deserialize, Serialize};
use taceva_network::{Architecture, ConvolutionForm, LabelScale};

use crate::features::Preprocessing;

/// Settings of a network in a model file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NetworkCard {
    /// Architecture of the network.
    pub architecture: Architecture,
    /// Preprocessing of pictures.
    pub preprocessing: Preprocessing,
    /// Scale from outputs to labels.
    pub scale: LabelScale,
    /// Label of each channel that is constant in the training part, and predicted as such. `None` for other channels, which the
    /// outputs predict in order.
    pub constant: Vec<Option<f64>>,
    /// Form of convolutions for predictions.
    pub convolutions: ConvolutionForm,
    /// Instruction set of the CPU. Predictions on the same one are bitwise equal.
    pub instructions: String,
    /// GPU that trained the network. `None` for the CPU. Repeated training on a GPU gives other bits.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gpu: Option<String>,
}
