//! Seal of a file, with its history of accepted edits.

use serde::{Deserialize, Serialize};

/// Edit of a sealed file that a person accepted.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Edit {
    /// Date of the edit: `2026-11-22`.
    pub date: String,
    /// Digest of the content before the edit, or `unsealed` for a file without a seal.
    pub from: String,
    /// Digest of the accepted content, without this history entry.
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

/// Shortens a digest to enough digits for comparison by eye.
fn short(digest: &str) -> &str {
    digest.get(..15).unwrap_or(digest)
}

/// File with a valid seal.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Opened {
    /// Digest of the sealed content, `sha256:…`.
    pub digest: String,
    /// Accepted edits, oldest first.
    pub history: Vec<Edit>,
}
