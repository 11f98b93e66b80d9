//! Diagnosis: the result of one check.

use serde::Serialize;

/// Result of one check.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Diagnosis {
    /// Code of the check, stable across versions.
    pub code: &'static str,
    /// State of the examined subject.
    pub state: State,
    /// Subject of the check, such as `/dev/video0`.
    pub subject: String,
    /// Observation as text, with control characters escaped.
    pub detail: String,
    /// Remedy; `None` if none is needed or known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub remedy: Option<String>,
}

/// State of a subject.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum State {
    /// The subject is present and usable.
    Good,
    /// The subject is absent. This is a problem only if the device is needed.
    Absent,
    /// The subject is present but not usable.
    Problem,
}
