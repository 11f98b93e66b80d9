//! Why results cannot be read.

/// Why results cannot be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ResultsError {
    /// They are no JSON.
    #[error("not JSON: {0}")]
    Json(#[from] serde_json::Error),
    /// They were changed after they were sealed, or their seal is missing or unreadable.
    #[error("{0}")]
    Seal(#[from] taceva_files::seal::SealError),
    /// They have no schema, or one that is not known here.
    #[error("{found}: expected `taceva.evaluation/1` or `taceva.run/1`")]
    Schema {
        /// What was found.
        found: String,
    },
    /// Some place holds something else than it should.
    #[error("{place}: expected {expected}, found {found}")]
    Place {
        /// Where: `metrics.mae.Fz.value`.
        place: String,
        /// What should be there.
        expected: &'static str,
        /// What is there.
        found: String,
    },
}
