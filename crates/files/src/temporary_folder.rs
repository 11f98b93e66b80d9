//! Temporary folders with random names and owner-only access. Leftovers of killed processes are removed.

use std::collections::BTreeSet;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::durable::{parent_of, sync_folder};

/// Marker file in the temporary folders of this crate, locked while the process that created the folder runs.
pub(crate) const MARKER: &str = ".taceva-temporary";
/// Name prefix of the old version of a target, which is kept in a temporary folder until the new version is in place.
pub(crate) const FORMER: &str = "replaced-";
/// Maximum number of attempts to create a folder, if another process removes it before it is locked.
const CREATIONS: u32 = 16;
/// Number of random letters and digits after the prefix of a name.
const RANDOM: usize = 6;

/// Temporary folders of this process that are removed at exit. Folders whose content is being published are not in this set.
static OWN: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Removes the temporary folders of this process, for a program that exits while other threads still work.
///
/// After the call, a thread that makes or removes a temporary folder, or replaces a target, blocks until the exit. A folder in which another thread writes
/// during the call can remain. The next process removes that folder, unless the thread recreated it after its marker was removed.
pub fn remove_before_exit() {
    let own = own();
    for path in own.iter() {
        drop(remove(path));
    }
    // Never unlocked, so that nothing is put in place from a folder that is gone.
    std::mem::forget(own);
}

fn own() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    OWN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Folder with a random name and owner-only access, removed on drop.
///
/// ```
/// use taceva_files::TemporaryFolder;
///
/// let parent = tempfile::tempdir()?;
/// let folder = TemporaryFolder::create(parent.path(), ".unpacked-")?;
/// let content = folder.path().join("content");
/// std::fs::create_dir(&content)?;
/// drop(folder);
/// assert!(!content.exists());
/// # Ok::<(), std::io::Error>(())
/// ```
#[derive(Debug)]
pub struct TemporaryFolder {
    path: PathBuf,
    /// Open marker file, which keeps the lock.
    _marker: File,
}

impl TemporaryFolder {
    /// Creates a folder in `parent` whose name begins with `prefix`. Removes folders of killed processes with the same prefix and owner.
    ///
    /// Links, folders of other owners, and folders with content but without a marker are not removed.
    ///
    /// # Errors
    /// [`io::Error`] of the file system.
    pub fn create(parent: &Path, prefix: &str) -> io::Result<TemporaryFolder> {
        let made = TemporaryFolder::make(parent, prefix)?;
        clear(parent, prefix);
        Ok(made)
    }

    /// Creates a folder without removing leftovers.
    pub(crate) fn make(parent: &Path, prefix: &str) -> io::Result<TemporaryFolder> {
        for _ in 0..CREATIONS {
            let mut builder = tempfile::Builder::new();
            #[cfg(unix)]
            builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o700));
            let folder = builder
                .prefix(prefix)
                .rand_bytes(RANDOM)
                .tempdir_in(parent)?;
            let path = folder.path().join(MARKER);
            let marker = match OpenOptions::new().write(true).create_new(true).open(&path) {
                // Another process removed it as an empty leftover.
                Err(error) if error.kind() == io::ErrorKind::NotFound => continue,
                marker => marker?,
            };
            let is_taken = matches!(marker.try_lock(), Err(TryLockError::WouldBlock));
            // Another process removed it as a leftover before it was locked.
            if is_taken || !path.exists() {
                continue;
            }
            // After a power loss, no content exists without its marker.
            sync_folder(folder.path())?;
            let path = folder.keep();
            own().insert(path.clone());
            return Ok(TemporaryFolder {
                path,
                _marker: marker,
            });
        }
        Err(io::Error::other(
            "another program removes each temporary folder as soon as it is created",
        ))
    }

    /// Path of the folder.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Excludes the folder from [`remove_before_exit`], because its content is about to be published. `remove_before_exit` waits until the returned guard is
    /// dropped.
    pub(crate) fn disown(&self) -> MutexGuard<'static, BTreeSet<PathBuf>> {
        let mut own = own();
        own.remove(&self.path);
        own
    }
}

impl Drop for TemporaryFolder {
    fn drop(&mut self) {
        drop(self.disown());
        // The next process removes the rest.
        drop(remove(&self.path));
    }
}

/// Removes folders of this user in `parent` whose name begins with `prefix` and whose marker is not locked.
pub(crate) fn clear(parent: &Path, prefix: &str) {
    let mut is_durable = false;
    for path in folders(parent, prefix) {
        if is_living(&path) {
            continue;
        }
        // The new version must survive a power loss before the old one is removed.
        is_durable = is_durable || sync_folder(parent).is_ok();
        if is_durable {
            drop(remove_dead(&path));
        }
    }
}

/// Folders in `parent` that belong to this user, with a name of `prefix` and [`RANDOM`] letters or digits; links are ignored.
pub(crate) fn folders(parent: &Path, prefix: &str) -> impl Iterator<Item = PathBuf> {
    let entries = fs::read_dir(parent).into_iter().flatten().flatten();
    entries.filter_map(move |entry| {
        let name = entry.file_name();
        let rest = name.to_str()?.strip_prefix(prefix)?;
        let is_ours = rest.len() == RANDOM && rest.bytes().all(|byte| byte.is_ascii_alphanumeric());
        // Type of the entry itself, so links are ignored.
        let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
        let path = entry.path();
        (is_ours && is_folder && is_of_this_user(&path)).then_some(path)
    })
}

/// True if the process that made the folder at `path` still locks its marker.
pub(crate) fn is_living(path: &Path) -> bool {
    marker(path).is_some_and(|marker| matches!(marker.try_lock(), Err(TryLockError::WouldBlock)))
}

/// Opens the marker in the folder at `path`; `None` without a marker or if the marker is a link.
fn marker(path: &Path) -> Option<File> {
    let marker = path.join(MARKER);
    let is_file = fs::symlink_metadata(&marker).is_ok_and(|marker| marker.is_file());
    is_file.then(|| File::open(&marker).ok())?
}

/// Removes the folder of an ended process. A folder without a marker is removed only if it is empty.
fn remove_dead(path: &Path) -> io::Result<()> {
    let Some(marker) = marker(path) else {
        return fs::remove_dir(path);
    };
    // The lock is held until the folder is gone, so no other process removes a new folder of the same name.
    match marker.try_lock() {
        Ok(()) => remove(path),
        Err(_) => Ok(()),
    }
}

/// Removes a marked folder. The marker is removed last, so that an interrupted removal is recognised.
///
/// Does not remove a folder that another process reads, or a folder with the old version of a missing target.
fn remove(path: &Path) -> io::Result<()> {
    let mut inner = Vec::new();
    let mut held = Vec::new();
    for entry in fs::read_dir(path)? {
        let entry = entry?;
        let name = entry.file_name();
        let former = name.to_str().and_then(|name| name.strip_prefix(FORMER));
        if former.is_some_and(|name| fs::symlink_metadata(parent_of(path).join(name)).is_err()) {
            return Ok(());
        }
        let is_folder = entry.file_type()?.is_dir();
        if is_folder {
            let folder = File::open(entry.path())?;
            if matches!(folder.try_lock(), Err(TryLockError::WouldBlock)) {
                return Ok(());
            }
            held.push(folder);
        }
        if name != MARKER {
            inner.push((entry.path(), is_folder));
        }
    }
    for (path, is_folder) in inner {
        match is_folder {
            true => fs::remove_dir_all(path)?,
            false => fs::remove_file(path)?,
        }
    }
    // A power loss can leave content without its marker if the sync fails. The folder is removed all the same.
    drop(sync_folder(path));
    match fs::remove_file(path.join(MARKER)) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => fs::remove_dir(path),
    }
}

/// True if the entry at `path` belongs to the user of this process.
#[cfg(unix)]
fn is_of_this_user(path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let owner = fs::symlink_metadata(path).map(|metadata| metadata.uid());
    owner.is_ok_and(|owner| owner == rustix::process::geteuid().as_raw())
}

#[cfg(not(unix))]
fn is_of_this_user(_path: &Path) -> bool {
    true
}

#[cfg(test)]
mod tests;
