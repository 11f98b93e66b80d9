//! The seal of a file and its history of accepted edits.

use serde::{Deserialize, Serialize};

/// An accepted edit.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Edit {
    /// Date of the edit: `2026-11-22`.
    pub date: String,
    /// The digest before, or `unsealed`.
    pub from: String,
    /// The digest of the content that was accepted, without this entry.
    pub to: String,
    /// Reason, in the words of the person who accepted the edit.
    pub reason: String,
}

impl std::fmt::Display for Edit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Edit {
            date,
            from,
            to,
            reason,
        } = self;
        write!(f, "{date}: {reason} ({} → {})", short(from), short(to))
    }
}

/// Enough digits of a digest to distinguish it from another.
fn short(digest: &str) -> &str {
    digest.get(..15).unwrap_or(digest)
}

/// A file whose seal holds.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Opened {
    /// The digest of what it says, `sha256:…`.
    pub digest: String,
    /// The edits that were accepted, oldest first.
    pub history: Vec<Edit>,
}
