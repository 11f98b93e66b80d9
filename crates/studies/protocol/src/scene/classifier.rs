//! Classifiers of grating spacings.

use serde::{Deserialize, Serialize};

/// Classifier that predicts the spacing of a grating from its frame. It is fitted separately for lines and for dots.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum GratingClassifier {
    /// Linear discriminant analysis of the radial spectrum of the frame.
    #[default]
    Spectrum,
    /// Multinomial logistic regression, by linfa, on the radial spectrum of the frame.
    #[serde(rename = "linfa/logistic")]
    LinfaLogistic,
    /// A small convolutional network with one output for each spacing.
    Cnn,
    /// A small convolutional network with a single output, the spacing. It can predict spacings between the training spacings.
    CnnLength,
}
