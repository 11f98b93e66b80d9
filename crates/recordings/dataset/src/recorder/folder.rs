//! Folder of a recording, when it begins and when it is resumed.

use std::fs::{self, File};
use std::io::ErrorKind;
use std::path::Path;

use crate::error::DatasetError;
use crate::file::{make_names_durable, refuse_link};
use crate::journal::Journal;
use crate::layout;
use crate::lock::lock_folder;

/// Locks a folder without a recording: a new folder, or one whose creation was interrupted.
pub(super) fn empty_folder(path: &Path) -> Result<File, DatasetError> {
    match fs::create_dir(path) {
        Ok(()) => return lock_folder(path),
        Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
        Err(error) => return Err(DatasetError::io("create", path)(error)),
    }
    let taken = || DatasetError::TargetExists {
        path: path.to_owned(),
    };
    if !path.is_dir() {
        return Err(taken());
    }
    let lock = lock_folder(path)?;
    let entries = fs::read_dir(path).map_err(DatasetError::io("list", path))?;
    for entry in entries {
        let entry = entry.map_err(DatasetError::io("list", path))?;
        let name = entry.file_name();
        let kind = (entry.file_type()).map_err(DatasetError::io("read", &entry.path()))?;
        // A link with one of our names would redirect the recording to another place.
        if kind.is_symlink() || (name != layout::JOURNAL && name != layout::FRAMES) {
            return Err(taken());
        }
    }
    let journal = path.join(layout::JOURNAL);
    if journal.exists() {
        let (_, recovered) = Journal::open(&journal)?;
        if !recovered.records.is_empty() {
            return Err(taken());
        }
        fs::remove_file(&journal).map_err(DatasetError::io("remove", &journal))?;
    }
    Ok(lock)
}

/// Locks the folder of a recording that was not closed.
pub(super) fn unclosed_folder(path: &Path) -> Result<File, DatasetError> {
    let lock = lock_folder(path)?;
    let header = path.join(layout::HEADER);
    if header.exists() {
        if path.join(layout::JOURNAL).exists() {
            // A header beside the journal means a close that was interrupted before its last step. A link in place of the header does not.
            refuse_link(&header)?;
            remove_journal(path)?;
        }
        return Err(DatasetError::TargetExists { path: header });
    }
    refuse_links(path)?;
    Ok(lock)
}

/// Rejects symbolic links in the recording at `path`, because data would be appended to their targets.
///
/// A link created after this check is followed. Users with write access to the folder are trusted.
fn refuse_links(path: &Path) -> Result<(), DatasetError> {
    for folder in [path.to_owned(), path.join(layout::FRAMES)] {
        let entries = match fs::read_dir(&folder) {
            Err(error) if error.kind() == ErrorKind::NotFound => continue,
            entries => entries.map_err(DatasetError::io("list", &folder))?,
        };
        for entry in entries {
            let entry = entry.map_err(DatasetError::io("list", &folder))?;
            refuse_link(&entry.path())?;
        }
    }
    Ok(())
}

pub(super) fn remove_journal(path: &Path) -> Result<(), DatasetError> {
    let journal = path.join(layout::JOURNAL);
    fs::remove_file(&journal).map_err(DatasetError::io("remove", &journal))?;
    make_names_durable(path)
}
