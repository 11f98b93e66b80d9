//! Replacement of a dataset by a new version, and recovery after an interruption.
//!
//! The new dataset is complete and durable beside its target before the two names are exchanged. Readers therefore see either the old or the new dataset. A
//! file system that cannot exchange names needs two renames. A reader between the two renames finds the old dataset under a hidden name, and restores it if the
//! writer process has ended.

use std::ffi::OsString;
use std::fs;
use std::path::Path;

use crate::error::DatasetError;
use crate::layout;

/// Restores the dataset at `target` after an interrupted replacement, and removes the leftovers. Every command that opens the dataset calls this first. Waits
/// up to 2 s for a writer that is still running.
///
/// # Errors
/// [`DatasetError::Io`] if the old dataset under its hidden name cannot be restored.
pub fn settle(target: &Path) -> Result<(), DatasetError> {
    taceva_files::settle(target).map_err(DatasetError::io("put back", target))
}

/// Name of an entry in the folder at `path` that belongs to no dataset or recording; `None` if there is none.
pub(crate) fn foreign_entry(path: &Path) -> Option<OsString> {
    let mut names = fs::read_dir(path)
        .ok()?
        .flatten()
        .map(|entry| entry.file_name());
    names.find(|name| !layout::ALL.iter().any(|ours| name == ours))
}

/// True if there is a dataset at `path`, damaged or not.
pub(crate) fn is_dataset(path: &Path) -> bool {
    path.join(layout::HEADER).is_file()
}
