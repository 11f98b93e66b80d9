//! What a model file says of a network, beside its tensors.

use serde::{Deserialize, Serialize};
use taceva_network::{Architecture, ConvolutionForm, LabelScale};

use crate::features::Preprocessing;

/// What a model file says of a network.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NetworkCard {
    /// Which layers it has, and of which sizes.
    pub architecture: Architecture,
    /// What is done to pictures before the network sees them.
    pub preprocessing: Preprocessing,
    /// How outputs become labels.
    pub scale: LabelScale,
    /// The label of each channel that never changed in the training part, and is predicted as that; nothing for those
    /// that the outputs stand for, one after the other.
    pub constant: Vec<Option<f64>>,
    /// The form in which convolutions are computed for predictions.
    pub convolutions: ConvolutionForm,
    /// The instructions of the processor: on the same ones predictions have the same bits.
    pub instructions: String,
    /// The GPU that trained it, where the processor did not; trained there anew, it has other bits.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gpu: Option<String>,
}
