//! Handle of a dataset folder. Reads the same files even after the folder was renamed.

use std::fs::{File, TryLockError};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::time::Duration;

use rustix::fs::{Mode, OFlags, openat};

use crate::error::DatasetError;
use crate::file::is_same;
use crate::layout;
use crate::replacement::settle;

/// Number of attempts to open a folder that another process is replacing, `PAUSE` apart.
const ATTEMPTS: u32 = 200;
const PAUSE: Duration = Duration::from_millis(1);

/// Folder with a shared lock. A process that replaces the dataset keeps the old folder until the lock is released.
#[derive(Debug)]
pub(crate) struct HeldFolder {
    path: PathBuf,
    /// Handle of the folder; `None` if there is no folder.
    handle: Option<File>,
}

impl HeldFolder {
    /// Opens and locks the folder at `path`, if it exists, after completing an interrupted replacement.
    pub(crate) fn open(path: &Path) -> Result<HeldFolder, DatasetError> {
        settle(path)?;
        for attempt in 0..ATTEMPTS {
            // Opening a pipe must not wait for its other end.
            let flags = OFlags::RDONLY | OFlags::CLOEXEC | OFlags::NONBLOCK;
            let opened = rustix::fs::open(path, flags, Mode::empty());
            let handle = match opened.map_err(io::Error::from) {
                Ok(handle) => File::from(handle),
                Err(error) if error.kind() == io::ErrorKind::NotFound => {
                    // If names cannot be exchanged, the name is missing for a moment between two renames.
                    settle(path)?;
                    if path.exists() {
                        continue;
                    }
                    return Ok(HeldFolder {
                        path: path.to_owned(),
                        handle: None,
                    });
                }
                Err(error) => return Err(DatasetError::io("open", path)(error)),
            };
            let is_locked = match handle.try_lock_shared() {
                // A recorder has no header yet, and a replacing process releases the lock within the attempts.
                Err(TryLockError::WouldBlock) => !is_there(&handle, layout::HEADER),
                // Without lock support there is nothing to wait for.
                Ok(()) | Err(TryLockError::Error(_)) => true,
            };
            let is_last = attempt + 1 == ATTEMPTS;
            if (is_locked && is_same(&handle, path)) || is_last {
                return Ok(HeldFolder {
                    path: path.to_owned(),
                    handle: Some(handle),
                });
            }
            std::thread::sleep(PAUSE);
        }
        unreachable!("the last attempt returns")
    }

    /// Copy with the same path but without a handle, for joined recordings, whose files are read through the handle of each recording.
    pub(crate) fn without_files(&self) -> HeldFolder {
        HeldFolder {
            path: self.path.clone(),
            handle: None,
        }
    }

    /// Another handle of the same folder.
    pub(crate) fn again(&self) -> Result<HeldFolder, DatasetError> {
        let handle = self.handle.as_ref().map(File::try_clone).transpose();
        Ok(HeldFolder {
            path: self.path.clone(),
            handle: handle.map_err(DatasetError::io("hold", &self.path))?,
        })
    }

    /// Path under which the folder was opened.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// True if the folder has an entry called `name`.
    pub(crate) fn has(&self, name: &str) -> bool {
        let handle = self.handle.as_ref();
        handle.is_some_and(|handle| is_there(handle, name))
    }

    /// Opens the regular file `relative` in this folder, of at most `cap` bytes. Returns the file and its size, bytes.
    pub(crate) fn file(&self, relative: &str, cap: u64) -> Result<(File, u64), DatasetError> {
        let path = self.path.join(relative);
        let wrong = DatasetError::io("open", &path);
        let Some(handle) = &self.handle else {
            return Err(wrong(io::ErrorKind::NotFound.into()));
        };
        let (file, metadata) = open_in(handle, relative)
            .and_then(|file| file.metadata().map(|metadata| (file, metadata)))
            .map_err(wrong)?;
        crate::file::check_regular(&path, &metadata, cap)?;
        Ok((file, metadata.len()))
    }

    /// Bytes of the regular file `relative` in this folder.
    pub(crate) fn read(&self, relative: &str, cap: u64) -> Result<Vec<u8>, DatasetError> {
        let (file, length) = self.file(relative, cap)?;
        let mut bytes = Vec::with_capacity(usize::try_from(length).unwrap_or(0));
        file.take(cap)
            .read_to_end(&mut bytes)
            .map_err(DatasetError::io("read", &self.path.join(relative)))?;
        Ok(bytes)
    }
}

/// Opens a file for reading. Does not block on a FIFO without a writer.
fn open_in(folder: &File, relative: &str) -> io::Result<File> {
    let flags = OFlags::RDONLY | OFlags::CLOEXEC | OFlags::NONBLOCK;
    Ok(File::from(openat(folder, relative, flags, Mode::empty())?))
}

fn is_there(folder: &File, name: &str) -> bool {
    use rustix::fs::{AtFlags, statat};
    statat(folder, name, AtFlags::empty()).is_ok()
}
