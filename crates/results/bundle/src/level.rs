//! Levels of a verification.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Depth to which a bundle is verified. Each level requires the levels before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum Level {
    /// The files equal the entries of the manifest, byte for byte.
    Files,
    /// Schemas, seals and generated files are valid, and the results contain the claims.
    Form,
    /// States reproduce the scores.
    Scores,
    /// Tables reproduce the states and the scores.
    Predictions,
    /// The model reproduces the predictions in the tables when it predicts on the recording again.
    Model,
    /// A fit by the model card reproduces the model, or gives scores within the intervals of the claims.
    Fit,
}

impl Level {
    /// All levels, in the order in which they are verified.
    ///
    /// ```
    /// use taceva_bundle::Level;
    /// assert!(Level::ALL.is_sorted());
    /// assert_eq!(Level::Predictions.to_string(), "predictions");
    /// ```
    pub const ALL: [Level; 6] = [
        Level::Files,
        Level::Form,
        Level::Scores,
        Level::Predictions,
        Level::Model,
        Level::Fit,
    ];
}

impl fmt::Display for Level {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Level::Files => "files",
            Level::Form => "form",
            Level::Scores => "scores",
            Level::Predictions => "predictions",
            Level::Model => "model",
            Level::Fit => "fit",
        })
    }
}
