//! Classifiers of the spacing of a grating.

use serde::{Deserialize, Serialize};

/// Classifier of the spacing of a grating from its picture, with separate fits for lines and dots.
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
    /// A small network with one output, the spacing, which may be between those of the training samples.
    CnnLength,
}
