//! Source files of an import, with their digests.

use serde::{Deserialize, Serialize};

use crate::digest::Digest;

/// List of the digests of all imported source files, in the format of `sha256sum`, one line per file.
///
/// ```
/// use taceva_dataset::{Digest, SourcesInfo};
///
/// let list = format!("{}  labels.csv\n", "0".repeat(64));
/// let info = SourcesInfo::of(&list);
/// assert_eq!((info.files, info.sha256), (1, Digest::of(list.as_bytes())));
/// ```
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct SourcesInfo {
    /// Number of files.
    pub files: u64,
    /// Digest of the list itself.
    pub sha256: Digest,
}

impl SourcesInfo {
    /// Facts about a list; lines that begin with `#` name no file.
    pub fn of(list: &str) -> SourcesInfo {
        let files = list.lines().filter(|line| !line.starts_with('#'));
        SourcesInfo {
            files: files.count() as u64,
            sha256: Digest::of(list.as_bytes()),
        }
    }
}
