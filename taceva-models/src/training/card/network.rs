//! Network settings in a model card.

use serde::{Deserialize, Serialize};
use taceva_network::{Architecture, ConvolutionForm, LabelScale};

use crate::features::Preprocessing;

/// Architecture, preprocessing and output of a network, as stored in a model card.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NetworkCard {
    /// Architecture of the network.
    pub architecture: Architecture,
    /// Preprocessing of the pictures that the network reads.
    pub preprocessing: Preprocessing,
    /// Scale of each output, by which outputs are converted to labels.
    pub scale: LabelScale,
    /// Constant training label of each channel, which is predicted without the network. `None` for other channels. The network has one output for
    /// each of them, in the order of the channels.
    pub constant: Vec<Option<f64>>,
    /// Algorithm of convolutions for predictions.
    pub convolutions: ConvolutionForm,
    /// Instruction set of the CPU that fitted the network. Predictions with the same instruction set are bitwise equal.
    pub instructions: String,
    /// GPU that trained the network; `None` for the CPU. Repeated training on a GPU gives different weights.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gpu: Option<String>,
    /// Classes that the outputs stand for; `None` if the outputs predict numbers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub classes: Option<ClassCard>,
}

/// Classes of the outputs of a network.
///
/// ```
/// let text = r#"{"labels": [0.0, 1.0], "temperature": 1.5, "calibrated_on": 40}"#;
/// let card: taceva_models::ClassCard = serde_json::from_str(text)?;
/// assert_eq!(card.labels.len(), 2);
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ClassCard {
    /// Label of each output, ascending.
    pub labels: Vec<f64>,
    /// Divisor of the outputs before the softmax that gives probabilities.
    pub temperature: f64,
    /// Number of validation samples from which the temperature was computed; 0 if it was not computed.
    pub calibrated_on: usize,
}
