//! A folder that appears atomically.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use taceva_files::parent_of;

use crate::error::DatasetError;
use crate::file::{is_same, make_names_durable};
use crate::layout;
use crate::lock::lock_folder;
use crate::replacement;
use crate::text::shown;

/// Maximum attempts to create a folder that vanishes before it is locked.
const CREATIONS: u32 = 100;

/// Permitted content of the target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[doc(hidden)]
pub enum Place {
    /// Nothing.
    Free,
    /// Nothing, or a dataset, which is replaced at the end.
    OfDataset,
}

/// A hidden sibling of the target, renamed once everything in it is durable, and removed if that never happens.
///
/// It is locked while in use, which distinguishes it from the leftover of a killed process.
#[derive(Debug)]
#[doc(hidden)]
pub struct StagedFolder {
    target: PathBuf,
    path: PathBuf,
    lock: Option<File>,
    place: Place,
    is_in_place: bool,
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
        let path = replacement::partial_name(&target).ok_or_else(|| DatasetError::Request {
            path: target.clone(),
            problem: "no name for a new folder".to_owned(),
        })?;
        for _ in 0..CREATIONS {
            let created = fs::create_dir(&path);
            if matches!(&created, Err(error) if error.kind() == io::ErrorKind::AlreadyExists) {
                remove_leftover(&path, &target)?;
                continue;
            }
            created.map_err(DatasetError::io("create", &path))?;
            let lock = match lock_folder(&path) {
                // Another process removed it as a leftover before it was locked.
                Err(DatasetError::Io { source, .. })
                    if source.kind() == io::ErrorKind::NotFound =>
                {
                    continue;
                }
                lock => lock?,
            };
            if is_same(&lock, &path) {
                return Ok(StagedFolder {
                    target,
                    path,
                    lock: Some(lock),
                    place,
                    is_in_place: false,
                });
            }
        }
        Err(DatasetError::Busy { path })
    }

    /// Path for writing.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Marks the folder as ours until it is renamed, for an export, whose files have other names than those of a dataset.
    pub fn mark(&self) -> Result<(), DatasetError> {
        let path = self.path.join(layout::MARK);
        fs::write(&path, "").map_err(DatasetError::io("create", &path))
    }

    /// Creates a folder inside.
    pub fn create_folder(&self, relative: &str) -> Result<(), DatasetError> {
        let path = self.path.join(relative);
        fs::create_dir(&path).map_err(DatasetError::io("create", &path))
    }

    /// Creates a folder inside, unless it exists already.
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

    /// Makes the names in this folder and in the given ones durable, then renames it to its target. This is atomic, with or without an
    /// existing target, if the file system can exchange names.
    pub fn put_in_place(self, folders: &[String]) -> Result<(), DatasetError> {
        self.put_in_place_by(folders, replacement::exchange)
    }

    fn put_in_place_by(
        mut self,
        folders: &[String],
        exchange: impl Fn(&Path, &Path) -> io::Result<bool>,
    ) -> Result<(), DatasetError> {
        for folder in folders {
            make_names_durable(&self.path.join(folder))?;
        }
        let mark = self.path.join(layout::MARK);
        match fs::remove_file(&mark) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => {
                return Err(DatasetError::io("remove", &mark)(error));
            }
            _ => make_names_durable(&self.path)?,
        }
        check_place(&self.target, self.place)?;
        let replaces = fs::symlink_metadata(&self.target).is_ok();
        let swapped = |exchanged: io::Result<bool>| {
            exchanged.map_err(DatasetError::io(
                "exchange with its successor",
                &self.target,
            ))
        };
        let old = if !replaces {
            fs::rename(&self.path, &self.target)
                .map_err(DatasetError::io("rename into place", &self.target))?;
            None
        } else if swapped(exchange(&self.path, &self.target))? {
            Some(self.path.clone())
        } else {
            let aside = replacement::move_aside(&self.target, &self.target)?;
            if let Err(error) = fs::rename(&self.path, &self.target) {
                // If this fails as well, the next process that opens the dataset restores it.
                let _ = fs::rename(&aside, &self.target);
                return Err(DatasetError::io("rename into place", &self.target)(error));
            }
            Some(aside)
        };
        if let Err(error) = make_names_durable(parent_of(&self.target)) {
            // The name may not survive a power cut: an error promises that the target is unchanged.
            let _ = match &old {
                None => fs::rename(&self.target, &self.path),
                Some(old) if *old == self.path => exchange(&self.path, &self.target).map(drop),
                Some(old) => fs::rename(&self.target, &self.path)
                    .and_then(|()| fs::rename(old, &self.target)),
            };
            return Err(error);
        }
        self.is_in_place = true;
        self.lock = None;
        if let Some(old) = old {
            replacement::retire(&old, &self.target);
        }
        Ok(())
    }
}

impl Drop for StagedFolder {
    fn drop(&mut self) {
        if !self.is_in_place {
            // A later call recognises and removes remaining files.
            let _ = fs::remove_dir_all(&self.path);
        }
    }
}

/// Checks that the content of `target` may be replaced. Only complete datasets without foreign files are replaced.
pub fn check_place(target: &Path, place: Place) -> Result<(), DatasetError> {
    let refused = |problem: String| {
        Err(DatasetError::Request {
            path: target.to_owned(),
            problem,
        })
    };
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
            "holds `{}`, which is no part of a dataset and would be lost; move it before --force",
            shown(&stranger.to_string_lossy())
        )),
        (Place::OfDataset, None) => Ok(()),
    }
}

/// Removes the folder that an interrupted import left at `path`; a replaced dataset that is still read is set aside.
fn remove_leftover(path: &Path, target: &Path) -> Result<(), DatasetError> {
    if path.is_symlink() {
        return Err(DatasetError::Request {
            path: path.to_owned(),
            problem: "in the way: a link, which is not followed; remove it".to_owned(),
        });
    }
    let is_export = path.join(layout::MARK).is_file();
    if let Some(stranger) = replacement::foreign_entry(path).filter(|_| !is_export) {
        return Err(DatasetError::Request {
            path: path.to_owned(),
            problem: format!(
                "in the way: it holds `{}`, which no import writes; move it",
                shown(&stranger.to_string_lossy())
            ),
        });
    }
    match lock_folder(path) {
        // Locked until it is gone, so that no other process takes it for a leftover.
        Ok(stale) => match is_same(&stale, path) {
            true => {
                replacement::remove(path).map_err(DatasetError::io("remove the leftover", path))
            }
            false => Ok(()),
        },
        Err(DatasetError::Io { source, .. }) if source.kind() == io::ErrorKind::NotFound => Ok(()),
        Err(DatasetError::Busy { .. }) if is_read(path) => {
            replacement::move_aside(path, target).map(drop)
        }
        Err(error) => Err(error),
    }
}

/// True if the processes that lock the folder at `path` only read it.
fn is_read(path: &Path) -> bool {
    replacement::is_dataset(path)
        && File::open(path).is_ok_and(|folder| folder.try_lock_shared().is_ok())
}

#[cfg(test)]
mod tests;
