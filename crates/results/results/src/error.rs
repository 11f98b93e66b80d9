//! Reasons why results are refused.

/// Reason why results are refused.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ResultsError {
    /// The text is no JSON.
    #[error("not JSON: {0}")]
    Json(#[from] serde_json::Error),
    /// The seal is missing, unreadable or of other content.
    #[error("{0}")]
    Seal(#[from] taceva_files::seal::SealError),
    /// The text names no schema of results.
    #[error("{found}: expected `taceva.evaluation/1.0` or `taceva.run/1.0`")]
    Schema {
        /// The schema found.
        found: String,
    },
    /// Another version of the program wrote the results.
    #[error(
        "schema `{found}`, written by TacEva {version}: expected `{expected}`; run `{command} …` again with this version"
    )]
    Version {
        /// The schema found.
        found: String,
        /// The version that wrote it, or `of an unknown version`.
        version: String,
        /// The schema of this version.
        expected: &'static str,
        /// The command that makes the results anew.
        command: &'static str,
    },
    /// A place holds another value than the schema says.
    #[error("{place}: {problem}")]
    Place {
        /// The place: `metrics.mae.Fz.value`.
        place: String,
        /// The value found and the value expected.
        problem: String,
    },
}
