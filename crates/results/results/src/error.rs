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
    /// The text names a schema that is not a schema of results.
    #[error("{found}: expected `taceva.evaluation/1.0` or `taceva.run/1.0`")]
    Schema {
        /// Schema that the text names.
        found: String,
    },
    /// Another version of the program wrote the results.
    #[error("schema `{found}`, written by TacEva {version}: expected `{expected}`; {remedy}")]
    Version {
        /// Schema that the text names.
        found: String,
        /// Version that wrote the results, or `of an unknown version`.
        version: String,
        /// Schema that the running program reads.
        expected: &'static str,
        /// Commands that compute the results again.
        remedy: &'static str,
    },
    /// A value has a type or content that the schema does not allow.
    #[error("{place}: {problem}")]
    Place {
        /// Path of the value in the JSON: `metrics.mae.Fz.value`.
        place: String,
        /// Value found and value expected.
        problem: String,
    },
}
