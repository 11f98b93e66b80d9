//! Files that an import read, with their digests.

use serde::{Deserialize, Serialize};

use crate::digest::Digest;

/// List of digests in the dataset, in the form of `sha256sum`: a line for each file that an import read.
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
    /// Digest of the list.
    pub sha256: Digest,
}

impl SourcesInfo {
    /// The facts of a list; lines that begin with `#` name no file.
    pub fn of(list: &str) -> SourcesInfo {
        let files = list.lines().filter(|line| !line.starts_with('#'));
        SourcesInfo {
            files: files.count() as u64,
            sha256: Digest::of(list.as_bytes()),
        }
    }
}
