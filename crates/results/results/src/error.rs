//! Errors of reading results.

/// Reason why results are rejected.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ResultsError {
    /// Invalid JSON.
    #[error("not JSON: {0}")]
    Json(#[from] serde_json::Error),
    /// The seal is missing, unreadable or does not match the content.
    #[error("{0}")]
    Seal(#[from] taceva_files::seal::SealError),
    /// The schema in the text is not a schema of results.
    #[error("{found}: expected `taceva.evaluation/1.0` or `taceva.run/1.0`")]
    Schema {
        /// Schema found.
        found: String,
    },
    /// Another version of the program wrote the results.
    #[error("schema `{found}`, written by TacEva {version}: expected `{expected}`; {remedy}")]
    Version {
        /// Schema found.
        found: String,
        /// Version that wrote the results, or `of an unknown version`.
        version: String,
        /// Schema of the running version.
        expected: &'static str,
        /// Commands that compute the results again.
        remedy: &'static str,
    },
    /// A value violates the schema.
    #[error("{place}: {problem}")]
    Place {
        /// Path of the value in the JSON: `metrics.mae.Fz.value`.
        place: String,
        /// Value found and value expected.
        problem: String,
    },
}
