//! Staging folder, which gets its final name in one step.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use taceva_files::Staged;

use crate::error::DatasetError;
use crate::file::make_names_durable;
use crate::replacement;
use crate::text::shown;

/// Permitted content at a target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[doc(hidden)]
pub enum Place {
    /// Nothing may exist at the target.
    Free,
    /// The target may be a dataset, which is replaced at the end.
    OfDataset,
}

/// Folder beside the target, which is renamed to the target once all content is durable. An unfinished folder is removed.
///
/// Only one process at a time can stage a target, so that no rows of another process are lost.
#[derive(Debug)]
#[doc(hidden)]
pub struct StagedFolder {
    target: PathBuf,
    staged: Staged,
    place: Place,
}

impl StagedFolder {
    pub fn create(target: &Path, place: Place) -> Result<StagedFolder, DatasetError> {
        let target = match target.is_symlink() {
            // The target of a link is replaced, not the link.
            true => fs::canonicalize(target).map_err(DatasetError::io("follow", target))?,
            false => target.to_owned(),
        };
        replacement::settle(&target)?;
        check_place(&target, place)?;
        let staged = Staged::alone(&target).map_err(DatasetError::io("write beside", &target))?;
        match staged {
            Some(staged) => Ok(StagedFolder {
                target,
                staged,
                place,
            }),
            None => Err(DatasetError::Busy { path: target }),
        }
    }

    /// Path of the staged folder, to which content is written.
    pub fn path(&self) -> &Path {
        self.staged.path()
    }

    /// Creates a folder inside the staged folder.
    pub fn create_folder(&self, relative: &str) -> Result<(), DatasetError> {
        let path = self.path().join(relative);
        fs::create_dir(&path).map_err(DatasetError::io("create", &path))
    }

    /// Creates a folder inside the staged folder, unless it exists.
    pub fn ensure_folder(&self, relative: &str) -> Result<(), DatasetError> {
        match self.create_folder(relative) {
            Err(DatasetError::Io { source, .. })
                if source.kind() == io::ErrorKind::AlreadyExists =>
            {
                Ok(())
            }
            created => created,
        }
    }

    /// Syncs the directory entries of this folder and of `folders`, then renames the folder to its target. The rename is atomic if the target is free
    /// or the file system can exchange names.
    pub fn put_in_place(self, folders: &[String]) -> Result<(), DatasetError> {
        for folder in folders {
            make_names_durable(&self.path().join(folder))?;
        }
        make_names_durable(self.path())?;
        check_place(&self.target, self.place)?;
        let StagedFolder { target, staged, .. } = self;
        let placed = staged.put_in_place();
        placed.map_err(DatasetError::io("put in place", &target))
    }
}

/// Checks that the content of `target` may be replaced. Only complete datasets without foreign files may be replaced.
pub fn check_place(target: &Path, place: Place) -> Result<(), DatasetError> {
    let refused = |problem: String| Err(DatasetError::request(target, problem));
    if fs::symlink_metadata(target).is_err() {
        return Ok(());
    }
    match (place, replacement::foreign_entry(target)) {
        (Place::Free, _) => Err(DatasetError::TargetExists {
            path: target.to_owned(),
        }),
        (Place::OfDataset, _) if !replacement::is_dataset(target) => {
            refused("--force replaces only datasets, and this is not a dataset".to_owned())
        }
        (Place::OfDataset, Some(stranger)) => refused(format!(
            "holds `{}`, which does not belong to a dataset and would be lost; move it before --force",
            shown(&stranger.to_string_lossy())
        )),
        (Place::OfDataset, None) => Ok(()),
    }
}

#[cfg(test)]
mod tests;
