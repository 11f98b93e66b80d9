//! Classifiers of grating spacings.

use serde::{Deserialize, Serialize};

/// Classifier of the spacing of a grating from its frame, with separate fits for lines and dots.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum GratingClassifier {
    /// Linear discriminants of the radial spectrum of the frame.
    #[default]
    Spectrum,
    /// Multinomial logistic regression of linfa on the same radial spectrum.
    #[serde(rename = "linfa/logistic")]
    LinfaLogistic,
    /// A small network with one output for each spacing.
    Cnn,
    /// A small network with a single output, the spacing; it can predict spacings between the training spacings.
    CnnLength,
}
