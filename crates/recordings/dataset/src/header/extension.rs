//! Addition of rows to a recording after its import.

use serde::{Deserialize, Serialize};

use super::Header;
use crate::digest::Digest;

/// State of a recording before rows were added, and the source of the rows.
///
/// ```
/// let text = "rows = 120\ndigest = \"sha256:e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855\"\ndate = \"2026-11-23\"\nfrom = \"tuesday\"\n";
/// let extension: taceva_dataset::Extension = toml::from_str(text)?;
/// assert_eq!((extension.rows, extension.from.as_str()), (120, "tuesday"));
/// # Ok::<(), toml::de::Error>(())
/// ```
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Extension {
    /// Number of samples before the addition. Added rows begin at this index, from 0.
    pub rows: u64,
    /// Digest of the dataset before the addition.
    pub digest: Digest,
    /// Day of the addition, UTC: `2026-11-23`.
    pub date: String,
    /// Folder of the import, as typed.
    pub from: String,
}

impl Extension {
    /// Addition to a recording that had `rows` rows and the digest `digest`. The rows come from the folder `from` and were added on `date`.
    pub fn new(
        rows: u64,
        digest: Digest,
        date: impl Into<String>,
        from: impl Into<String>,
    ) -> Extension {
        Extension {
            rows,
            digest,
            date: date.into(),
            from: from.into(),
        }
    }
}

impl Header {
    /// Digest and number of samples of each state of the recording: the states before each addition, then the present state.
    pub fn stages(&self) -> impl Iterator<Item = (Digest, u64)> + '_ {
        let before = self.extended.iter();
        let before = before.map(|extension| (extension.digest, extension.rows));
        before.chain([(self.digest, self.table.rows)])
    }
}
