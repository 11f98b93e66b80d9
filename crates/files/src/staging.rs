//! Atomic replacement of files and folders: a new version is written beside the target, then renamed into place.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, SystemTime};

use crate::durable::{parent_of, sync_folder};
use crate::temporary_folder::{FORMER, TemporaryFolder, clear, folders, is_living};

/// Name prefix of every staging folder.
pub const STAGED: &str = ".taceva-staged-";
/// Maximum number of waits for another process, which has moved the old version away but not yet moved the new version in.
const WAITS: u32 = 2_000;
const PAUSE: Duration = Duration::from_millis(1);
/// Resolution of modification times, with a margin. Changes that are further apart than this resolution have different times.
const CLOCK: Duration = Duration::from_secs(2);
/// Number of attempts to stage a target that another process stages. `CLAIM_PAUSE` is the base pause between the attempts.
const CLAIMS: u32 = 6;
const CLAIM_PAUSE: Duration = Duration::from_millis(3);

/// New version of a file or folder, staged beside its target. Removed on drop unless it replaced the target.
///
/// The staging folder has a random name, a marker and a lock. The next process that stages in the same parent folder removes leftovers of killed
/// processes.
///
/// ```
/// use std::fs;
/// use taceva_files::Staged;
///
/// let parent = tempfile::tempdir()?;
/// let target = parent.path().join("plugin");
/// let staged = Staged::beside(&target)?;
/// fs::create_dir(staged.path())?;
/// fs::write(staged.path().join("plugin.toml"), "id = 1")?;
/// staged.put_in_place()?;
/// assert!(target.join("plugin.toml").exists());
/// assert_eq!(fs::read_dir(parent.path())?.count(), 1);
/// # Ok::<(), std::io::Error>(())
/// ```
#[derive(Debug)]
pub struct Staged {
    target: PathBuf,
    path: PathBuf,
    folder: TemporaryFolder,
}

impl Staged {
    /// Creates a staging folder beside `target`; [`path`](Staged::path) does not exist yet. Removes leftovers of killed processes in the same parent
    /// folder.
    ///
    /// # Errors
    /// [`io::Error`] of the file system, or `InvalidInput` if `target` has no file name, or is a device, a pipe or a socket.
    pub fn beside(target: &Path) -> io::Result<Staged> {
        let staged = Staged::make(target)?;
        clear(parent_of(target), STAGED);
        Ok(staged)
    }

    /// Creates a staging folder like [`beside`](Staged::beside), with an empty folder at [`path`](Staged::path). Returns `None` while another process
    /// stages the same target.
    ///
    /// # Errors
    /// Errors of [`beside`](Staged::beside).
    pub fn alone(target: &Path) -> io::Result<Option<Staged>> {
        for attempt in 1..=CLAIMS {
            let staged = Staged::beside(target)?;
            // Creates the path before the search for rivals, so at least one of two processes finds the other.
            fs::create_dir(&staged.path)?;
            if !staged.has_rival() {
                return Ok(Some(staged));
            }
            drop(staged);
            let turn = std::process::id() % 7 + 1;
            std::thread::sleep(CLAIM_PAUSE * attempt * turn);
        }
        Ok(None)
    }

    fn make(target: &Path) -> io::Result<Staged> {
        let name = target.file_name().ok_or_else(|| {
            io::Error::new(
                io::ErrorKind::InvalidInput,
                "the path has no file or folder name",
            )
        })?;
        refuse_devices(target)?;
        let folder = TemporaryFolder::make(parent_of(target), STAGED)?;
        Ok(Staged {
            target: target.to_owned(),
            path: folder.path().join(name),
            folder,
        })
    }

    /// True if another living process stages the same target.
    fn has_rival(&self) -> bool {
        let name = self.path.file_name().unwrap_or_default();
        folders(parent_of(&self.target), STAGED).any(|other| {
            // Compares names, because another spelling of the same path is possible.
            other.file_name() != self.folder.path().file_name()
                && fs::symlink_metadata(other.join(name)).is_ok()
                && is_living(&other)
        })
    }

    /// Path to which the new version is written.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Replaces the target by the new version, in one step if the file system can exchange names. Removes the old version once no process reads it.
    ///
    /// The names inside a staged folder must be durable before the call. The name of the target is durable on return.
    ///
    /// # Errors
    /// [`io::Error`] of the file system. The target is unchanged after an error.
    pub fn put_in_place(self) -> io::Result<()> {
        self.put_in_place_by(exchange)
    }

    /// Replaces the target like [`put_in_place`](Staged::put_in_place), with `exchange` as the exchange of names. `exchange` returns false if the file system
    /// does not support exchanges.
    ///
    /// # Errors
    /// Errors of [`put_in_place`](Staged::put_in_place).
    #[doc(hidden)]
    pub fn put_in_place_by(
        self,
        exchange: impl Fn(&Path, &Path) -> io::Result<bool>,
    ) -> io::Result<()> {
        // No exit falls between two renames.
        let publishing = self.folder.disown();
        let (path, target) = (&self.path, &self.target);
        let mut former = std::ffi::OsString::from(FORMER);
        former.push(path.file_name().unwrap_or_default());
        let former = self.folder.path().join(former);
        let old = if fs::symlink_metadata(target).is_err() {
            fs::rename(path, target)?;
            None
        } else if exchange(path, target)? {
            Some(path)
        } else {
            fs::rename(target, &former)?;
            if let Err(error) = fs::rename(path, target) {
                // If this rename fails too, `settle` restores the old version later.
                drop(fs::rename(&former, target));
                return Err(error);
            }
            Some(&former)
        };
        drop(publishing);
        if let Err(error) = sync_folder(parent_of(target)) {
            // The new name may not survive a power loss, so the old version is put back.
            drop(match old {
                None => fs::rename(target, path),
                Some(old) if old == path => exchange(path, target).map(drop),
                Some(old) => fs::rename(target, path).and_then(|()| fs::rename(old, target)),
            });
            return Err(error);
        }
        Ok(())
    }
}

/// Replaces the file at `path`. `write` receives a path in a marked folder beside the file and writes the new content there.
///
/// A reader of `path` always sees the complete old or the complete new file. The new file is durable on return. The first call for a parent folder removes
/// leftovers of killed processes.
///
/// # Errors
/// Errors of `write` and of the file system, and `InvalidInput` as [`Staged::beside`]. After an error `path` is unchanged, unless only the sync of its folder
/// failed.
pub fn replace<E: From<io::Error>>(
    path: &Path,
    write: impl FnOnce(&Path) -> Result<(), E>,
) -> Result<(), E> {
    let staged = Staged::make(path)?;
    clear_once(parent_of(path));
    write(&staged.path)?;
    fs::File::open(&staged.path)?.sync_all()?;
    let publishing = staged.folder.disown();
    fs::rename(&staged.path, path)?;
    drop(publishing);
    Ok(sync_folder(parent_of(path))?)
}

/// Rejects a device, pipe or socket, such as `/dev/null`, and a link to an open file of the process, such as `/dev/stdout`. A rename would replace them.
fn refuse_devices(target: &Path) -> io::Result<()> {
    let leads_to_process = fs::read_link(target).is_ok_and(|to| to.starts_with("/proc"));
    match fs::metadata(target).map(|found| found.file_type()) {
        Ok(kind) if leads_to_process || (!kind.is_file() && !kind.is_dir()) => Err(io::Error::new(
            io::ErrorKind::InvalidInput,
            "a device, a pipe or a socket, expected a file; redirect standard output to it instead",
        )),
        // A target that cannot be looked at fails at its rename.
        _ => Ok(()),
    }
}

/// Restores the old version of `target` if a process was killed after it moved this version away, and removes leftovers. Waits for a process that is
/// still running.
///
/// # Errors
/// [`io::Error`] if the old version of `target` exists and cannot be restored.
pub fn settle(target: &Path) -> io::Result<()> {
    let parent = parent_of(target);
    for _ in 0..WAITS {
        if fs::symlink_metadata(target).is_ok() {
            clear_changed(parent);
            return Ok(());
        }
        let Some(former) = former_of(target) else {
            return Ok(());
        };
        if former.parent().is_some_and(is_living) {
            std::thread::sleep(PAUSE);
            continue;
        }
        match fs::rename(&former, target) {
            Ok(()) => sync_folder(parent)?,
            // Another process restored it first.
            Err(_) if fs::symlink_metadata(target).is_ok() => {}
            Err(error) if error.kind() == io::ErrorKind::NotFound => {}
            Err(error) => return Err(error),
        }
    }
    Ok(())
}

/// Removes the staging folders of killed processes from `parent`.
pub fn clear_leftovers(parent: &Path) {
    clear(parent, STAGED);
}

/// Calls [`clear_leftovers`] once per process and folder, so that a large folder is not listed for each file.
fn clear_once(parent: &Path) {
    static CLEARED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());
    let mut cleared = CLEARED.lock().unwrap_or_else(PoisonError::into_inner);
    if cleared.insert(parent.to_owned()) {
        drop(cleared);
        clear_leftovers(parent);
    }
}

/// Calls [`clear_leftovers`], unless the folder is unchanged since this process last found no leftovers in it.
fn clear_changed(parent: &Path) {
    static CLEAN: Mutex<BTreeMap<PathBuf, SystemTime>> = Mutex::new(BTreeMap::new());
    let lock = || CLEAN.lock().unwrap_or_else(PoisonError::into_inner);
    let changed = fs::metadata(parent).and_then(|parent| parent.modified());
    let Ok(changed) = changed else {
        return;
    };
    if lock().get(parent) == Some(&changed) {
        return;
    }
    clear_leftovers(parent);
    // A later change within the same tick of the file system's clock would have the same time.
    let is_past = changed.elapsed().is_ok_and(|age| age > CLOCK);
    if is_past && folders(parent, STAGED).next().is_none() {
        lock().insert(parent.to_owned(), changed);
    }
}

/// Temporary path of the old version of `target`, while another process replaces `target`.
fn former_of(target: &Path) -> Option<PathBuf> {
    let mut name = std::ffi::OsString::from(FORMER);
    name.push(target.file_name()?);
    let mut all = folders(parent_of(target), STAGED).map(|folder| folder.join(&name));
    all.find(|former| fs::symlink_metadata(former).is_ok_and(|found| !found.is_symlink()))
}

/// Exchanges two names atomically. Returns false if the file system does not support exchanges.
///
/// # Errors
/// [`io::Error`] of the file system.
#[doc(hidden)]
pub fn exchange(one: &Path, other: &Path) -> io::Result<bool> {
    #[cfg(any(target_os = "linux", target_os = "android", target_vendor = "apple"))]
    {
        use rustix::fs::{CWD, RenameFlags, renameat_with};
        use rustix::io::Errno;
        match renameat_with(CWD, one, CWD, other, RenameFlags::EXCHANGE) {
            Ok(()) => Ok(true),
            Err(Errno::INVAL | Errno::NOSYS | Errno::NOTSUP) => Ok(false),
            Err(error) => Err(error.into()),
        }
    }
    #[cfg(not(any(target_os = "linux", target_os = "android", target_vendor = "apple")))]
    {
        let _ = (one, other);
        Ok(false)
    }
}

#[cfg(test)]
mod tests;
