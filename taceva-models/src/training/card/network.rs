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
    /// Scale that converts outputs to labels.
    pub scale: LabelScale,
    /// Label of each channel with a constant label in the training part; the model predicts this label. `None` for other channels, which the outputs predict in
    /// order.
    pub constant: Vec<Option<f64>>,
    /// Algorithm of convolutions for predictions.
    pub convolutions: ConvolutionForm,
    /// Instruction set of the CPU that fitted the network. Predictions with the same instruction set are bitwise equal.
    pub instructions: String,
    /// GPU that trained the network; `None` for the CPU. Repeated training on a GPU gives other bits.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gpu: Option<String>,
    /// Classes of the outputs; `None` for outputs that are numbers.
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
    /// Number of samples of the validation part that set the temperature; 0 if the temperature was not set.
    pub calibrated_on: usize,
}
