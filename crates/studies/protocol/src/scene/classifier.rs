//! How the spacing of a grating is classified.

use serde::{Deserialize, Serialize};

/// What classifies the spacing of a grating from a picture of it, lines and dots apart.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum GratingClassifier {
    /// Linear discriminants of the radial spectrum of the picture.
    #[default]
    Spectrum,
    /// Multinomial logistic regression of linfa on the same radial spectrum.
    #[serde(rename = "linfa/logistic")]
    LinfaLogistic,
    /// A small network with an output for each spacing.
    Cnn,
    /// A small network with one output, the spacing itself, which may lie between those of the training samples.
    CnnLength,
}
