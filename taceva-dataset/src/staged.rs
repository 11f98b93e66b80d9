//! A folder that appears whole or not at all.

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

use crate::error::DatasetError;
use crate::file::{parent_of, sync_folder};

/// A hidden sibling of the target, renamed into place once everything in it is durable and removed if that never happens.
///
/// It is locked while in use, so that the leftover of a killed process is told from the work of a living one.
#[derive(Debug)]
pub(crate) struct StagedFolder {
    target: PathBuf,
    path: PathBuf,
    _lock: File,
    is_in_place: bool,
}

impl StagedFolder {
    pub(crate) fn create(target: &Path) -> Result<StagedFolder, DatasetError> {
        if fs::symlink_metadata(target).is_ok() {
            return Err(DatasetError::TargetExists {
                path: target.to_owned(),
            });
        }
        let name = target.file_name().ok_or_else(|| DatasetError::Request {
            path: target.to_owned(),
            problem: "no name for a new folder".to_owned(),
        })?;
        let mut hidden = std::ffi::OsString::from(".");
        hidden.push(name);
        hidden.push(".partial");
        let path = parent_of(target).join(hidden);
        let mut created = fs::create_dir(&path);
        if matches!(&created, Err(error) if error.kind() == io::ErrorKind::AlreadyExists) {
            // Held until it is gone: nobody else takes it for a leftover meanwhile.
            let _stale = lock_folder(&path)?;
            fs::remove_dir_all(&path).map_err(DatasetError::io("remove the leftover", &path))?;
            created = fs::create_dir(&path);
        }
        created.map_err(DatasetError::io("create", &path))?;
        let lock = lock_folder(&path)?;
        Ok(StagedFolder {
            target: target.to_owned(),
            path,
            _lock: lock,
            is_in_place: false,
        })
    }

    /// Where to write meanwhile.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Creates a folder inside.
    pub(crate) fn create_folder(&self, relative: &str) -> Result<(), DatasetError> {
        let path = self.path.join(relative);
        fs::create_dir(&path).map_err(DatasetError::io("create", &path))
    }

    /// Makes the names in this folder and in the given ones durable, then renames it to its target.
    pub(crate) fn put_in_place(mut self, folders: &[String]) -> Result<(), DatasetError> {
        for folder in folders {
            sync_folder(&self.path.join(folder))?;
        }
        sync_folder(&self.path)?;
        if fs::symlink_metadata(&self.target).is_ok() {
            return Err(DatasetError::TargetExists {
                path: self.target.clone(),
            });
        }
        fs::rename(&self.path, &self.target)
            .map_err(DatasetError::io("rename into place", &self.target))?;
        if let Err(error) = sync_folder(parent_of(&self.target)) {
            // Nobody knows whether the name would survive: an error promises that the target is absent.
            let _ = fs::rename(&self.target, &self.path);
            return Err(error);
        }
        self.is_in_place = true;
        Ok(())
    }
}

impl Drop for StagedFolder {
    fn drop(&mut self) {
        if !self.is_in_place {
            // What cannot be removed now is recognised and removed by the next one.
            let _ = fs::remove_dir_all(&self.path);
        }
    }
}

/// Locks a folder for this process; the system lets go when the process ends, however it ends.
pub(crate) fn lock_folder(path: &Path) -> Result<File, DatasetError> {
    let folder = File::open(path).map_err(DatasetError::io("open", path))?;
    match folder.try_lock() {
        Ok(()) => Ok(folder),
        Err(TryLockError::WouldBlock) => Err(DatasetError::Busy {
            path: path.to_owned(),
        }),
        Err(TryLockError::Error(source)) => Err(DatasetError::io("lock", path)(source)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_left_of_a_folder_that_is_not_put_in_place() {
        let folder = tempfile::tempdir().expect("a folder");
        let staged = StagedFolder::create(&folder.path().join("set")).expect("created");
        fs::write(staged.path().join("x"), "x").expect("written");
        drop(staged);
        assert_eq!(fs::read_dir(folder.path()).expect("there").count(), 0);
    }

    #[test]
    fn a_second_writer_is_refused_and_a_leftover_is_cleared() {
        let folder = tempfile::tempdir().expect("a folder");
        let target = folder.path().join("set");
        let first = StagedFolder::create(&target).expect("created");
        let second = StagedFolder::create(&target);
        assert!(
            matches!(second, Err(DatasetError::Busy { .. })),
            "{second:?}"
        );
        let path = first.path().to_owned();
        drop(first);
        fs::create_dir(&path).expect("a leftover");
        fs::write(path.join("junk"), "x").expect("written");
        let third = StagedFolder::create(&target).expect("cleared");
        third.put_in_place(&[]).expect("in place");
        assert_eq!(fs::read_dir(&target).expect("there").count(), 0);
    }
}
