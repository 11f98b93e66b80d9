//! Files without a table: each is a row, whose labels stand in its path alone.

use std::path::{Path, PathBuf};

/// A file that is a row.
#[derive(Debug)]
pub(crate) struct FileRows {
    path: PathBuf,
}

impl FileRows {
    /// The file at `path`.
    pub(super) fn one(path: &Path) -> FileRows {
        FileRows {
            path: path.to_owned(),
        }
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }
}
