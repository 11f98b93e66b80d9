//! The seal of a file and its history of accepted edits.

use serde::{Deserialize, Serialize};

/// An accepted edit.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Edit {
    /// When: `2026-11-22`.
    pub date: String,
    /// The digest before, or `unsealed`.
    pub from: String,
    /// The digest of the content that was accepted, without this entry.
    pub to: String,
    /// Why, in the words of the person who accepted it.
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

/// Whether files of a version have a seal.
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
    /// Whether it had a seal, which holds.
    pub is_sealed: bool,
    /// The digest of what it says, `sha256:…`.
    pub digest: String,
    /// The edits that were accepted, oldest first.
    pub history: Vec<Edit>,
}
