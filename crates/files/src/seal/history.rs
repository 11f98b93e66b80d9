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

/// Presence of a seal in files of a version.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Version {
    /// They have a seal.
    Sealed,
    /// They were written before there were seals; one that has a seal is checked all the same.
    BeforeSeals,
}

/// A file whose seal holds, or that is older than seals.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Opened {
    /// Set if the file had a seal.
    pub is_sealed: bool,
    /// The digest of what it says, `sha256:…`.
    pub digest: String,
    /// The edits that were accepted, oldest first.
    pub history: Vec<Edit>,
}
