//! Files without a table. Each file is a row, with labels only in its path.

use std::path::{Path, PathBuf};

/// Table with one row, which represents a file.
#[derive(Debug)]
pub(crate) struct FileRows {
    path: PathBuf,
}

impl FileRows {
    /// Table whose row represents the file at `path`.
    pub(super) fn one(path: &Path) -> FileRows {
        FileRows {
            path: path.to_owned(),
        }
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }
}
