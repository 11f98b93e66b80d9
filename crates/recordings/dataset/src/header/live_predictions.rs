//! Predictions that a model made during a recording.

use serde::{Deserialize, Serialize};

use crate::digest::Digest;

/// Predictions of a model, stored beside a recording in `predictions.csv`. The model predicted while frames were taken, and its predictions are not labels.
///
/// ```
/// use taceva_dataset::{Digest, LivePredictions};
///
/// let model = Digest::of(b"a model file");
/// let predictions = LivePredictions::new("ridge", model, b"sample,t_s,distance,Fz\nframe-000001,0.5,0.2,1.25\n");
/// assert_eq!(predictions.rows, 1);
/// assert!(predictions.to_string().starts_with("predictions by ridge sha256:"));
/// ```
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct LivePredictions {
    /// Name of the model.
    pub by: String,
    /// Digest of the model file.
    pub model: Digest,
    /// Number of predicted samples.
    pub rows: u64,
    /// Digest of the table of predictions.
    pub sha256: Digest,
}

impl LivePredictions {
    /// Facts about the predictions in `table`, which has a header line and one line per sample. `by` is the name of the model and `model` the digest of its
    /// file.
    pub fn new(by: impl Into<String>, model: Digest, table: &[u8]) -> LivePredictions {
        let lines = table.iter().filter(|byte| **byte == b'\n').count() as u64;
        LivePredictions {
            by: by.into(),
            model,
            rows: lines.saturating_sub(1),
            sha256: Digest::of(table),
        }
    }
}

/// Formats as `predictions by ridge sha256:…`.
impl std::fmt::Display for LivePredictions {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "predictions by {} {}", self.by, self.model)
    }
}
