//! A dataset that takes the place of another: what is done about an interruption, and what may be replaced.
//!
//! The new dataset is whole and durable in a marked folder beside its place before names are exchanged, so readers see the old one or the new
//! one at every moment. Where the file system cannot exchange names there is a moment between two renames; whoever looks for the dataset
//! then finds the old one, and puts it back if nobody is at work.

use std::ffi::OsString;
use std::fs;
use std::path::Path;

use crate::error::DatasetError;
use crate::layout;

/// Puts back or clears what an interrupted replacement of the dataset at `target` left beside it. Every command that opens the
/// dataset does so first; nothing is done while whoever replaces it is at work, nor where nothing may be written.
///
/// # Errors
/// [`DatasetError::Io`] if the old dataset under its hidden name cannot be restored.
pub fn settle(target: &Path) -> Result<(), DatasetError> {
    taceva_files::settle(target).map_err(DatasetError::io("put back", target))
}

/// A name in the folder at `path` that belongs to no dataset or recording.
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
