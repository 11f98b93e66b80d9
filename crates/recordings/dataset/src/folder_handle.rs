//! The folder of a dataset that is being read: held open, so that the same files are read whatever becomes of its name.

use std::fs::{File, TryLockError};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::time::Duration;

use rustix::fs::{Mode, OFlags, openat};

use crate::error::DatasetError;
use crate::file::is_same;
use crate::layout;
use crate::replacement::settle;

/// How often a folder that is being put in its place is tried again, and how long the pause before each try is.
const ATTEMPTS: u32 = 200;
const PAUSE: Duration = Duration::from_millis(1);

/// A folder with a shared lock: who replaces the dataset leaves the old one whole until the lock is released.
#[derive(Debug)]
pub(crate) struct HeldFolder {
    path: PathBuf,
    /// `None` where there is no folder.
    handle: Option<File>,
}

impl HeldFolder {
    /// Holds the folder at `path`, if there is one; what an interrupted replacement left there is put back or cleared before.
    pub(crate) fn open(path: &Path) -> Result<HeldFolder, DatasetError> {
        settle(path)?;
        for attempt in 0..ATTEMPTS {
            // Whoever names a pipe does not wait for its other end.
            let flags = OFlags::RDONLY | OFlags::CLOEXEC | OFlags::NONBLOCK;
            let opened = rustix::fs::open(path, flags, Mode::empty());
            let handle = match opened.map_err(io::Error::from) {
                Ok(handle) => File::from(handle),
                Err(error) if error.kind() == io::ErrorKind::NotFound => {
                    // Where names cannot be exchanged, there is a moment between two of them.
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
                // Whoever records has no header yet, and whoever replaces lets go within the attempts.
                Err(TryLockError::WouldBlock) => !is_there(&handle, layout::HEADER),
                // Where there are no locks nobody can be waited for.
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

    /// The same path, through which no file is read: of recordings that hold their files themselves.
    pub(crate) fn without_files(&self) -> HeldFolder {
        HeldFolder {
            path: self.path.clone(),
            handle: None,
        }
    }

    /// The same folder, held once more.
    pub(crate) fn again(&self) -> Result<HeldFolder, DatasetError> {
        let handle = self.handle.as_ref().map(File::try_clone).transpose();
        Ok(HeldFolder {
            path: self.path.clone(),
            handle: handle.map_err(DatasetError::io("hold", &self.path))?,
        })
    }

    /// The path that it was opened by.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Whether there is something called `name` in it.
    pub(crate) fn has(&self, name: &str) -> bool {
        let handle = self.handle.as_ref();
        handle.is_some_and(|handle| is_there(handle, name))
    }

    /// The regular file `relative` to this folder, which may hold at most `cap` bytes, and how many it holds.
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

    /// The bytes of the regular file `relative` to this folder.
    pub(crate) fn read(&self, relative: &str, cap: u64) -> Result<Vec<u8>, DatasetError> {
        let (file, length) = self.file(relative, cap)?;
        let mut bytes = Vec::with_capacity(usize::try_from(length).unwrap_or(0));
        file.take(cap)
            .read_to_end(&mut bytes)
            .map_err(DatasetError::io("read", &self.path.join(relative)))?;
        Ok(bytes)
    }
}

/// Opens for reading; never waits for the writer of a FIFO.
fn open_in(folder: &File, relative: &str) -> io::Result<File> {
    let flags = OFlags::RDONLY | OFlags::CLOEXEC | OFlags::NONBLOCK;
    Ok(File::from(openat(folder, relative, flags, Mode::empty())?))
}

fn is_there(folder: &File, name: &str) -> bool {
    use rustix::fs::{AtFlags, statat};
    statat(folder, name, AtFlags::empty()).is_ok()
}
