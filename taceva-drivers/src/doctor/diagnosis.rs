//! A diagnosis: one thing that was checked.

use serde::Serialize;

/// What is there, or missing, or in the way.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Diagnosis {
    /// A name that stays the same from version to version.
    pub code: &'static str,
    /// Whether it can be used.
    pub state: State,
    /// What it is about: `/dev/video0`.
    pub subject: String,
    /// What was seen, with control characters written out.
    pub detail: String,
    /// What to do, where something can be done.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub remedy: Option<String>,
}

/// Whether a thing is there and can be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum State {
    /// There, and usable.
    Good,
    /// Not there, which is fine unless it is needed.
    Absent,
    /// There, and not usable.
    Problem,
}
