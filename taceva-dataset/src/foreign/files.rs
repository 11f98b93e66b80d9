//! No table at all: a file is a row, and its path is what is known of it.

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
