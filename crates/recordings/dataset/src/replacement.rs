//! Replacement of a dataset: temporary names, and recovery from an interruption.
//!
//! The new dataset is complete and durable under a hidden name before names are exchanged, so readers always see the old or the new one. If
//! the file system cannot exchange names, the name is missing between two renames. A process that opens the dataset then finds the old one
//! set aside, and restores it if no process is replacing it.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

use taceva_files::parent_of;

use crate::error::DatasetError;
use crate::file::{is_same, make_names_durable};
use crate::layout;

/// Maximum old datasets of one name that are kept while they are read.
const SET_ASIDE: usize = 64;
/// Number of waits for a replacement between two renames, and the pause of each.
const WAITS: u32 = 2_000;
const PAUSE: Duration = Duration::from_millis(1);

/// The hidden name beside `target` under which its successor is written.
pub(crate) fn partial_name(target: &Path) -> Option<PathBuf> {
    hidden(target, ".partial")
}

/// The hidden name beside `target` for the `number`-th dataset set aside.
fn aside_name(target: &Path, number: usize) -> Option<PathBuf> {
    match number {
        0 => hidden(target, ".replaced"),
        _ => hidden(target, &format!(".{}.replaced", number + 1)),
    }
}

fn hidden(target: &Path, end: &str) -> Option<PathBuf> {
    let mut name = OsString::from(".");
    name.push(target.file_name()?);
    name.push(end);
    Some(parent_of(target).join(name))
}

/// Restores or clears the remains of an interrupted replacement of the dataset at `target`. Every command that opens the dataset calls it
/// first. It does nothing while a replacing process is active, or without write permission.
///
/// # Errors
/// [`DatasetError::Io`] if the old dataset under its hidden name cannot be restored.
pub fn settle(target: &Path) -> Result<(), DatasetError> {
    let (Some(partial), Some(first)) = (partial_name(target), aside_name(target, 0)) else {
        return Ok(());
    };
    for _ in 0..WAITS {
        if exists(target) {
            if is_dataset(target) {
                clear_beside(target, &partial, &first);
            }
            return Ok(());
        }
        let Some(aside) = set_aside(target) else {
            return Ok(());
        };
        if is_at_work(&partial) {
            std::thread::sleep(PAUSE);
            continue;
        }
        match fs::rename(&aside, target) {
            Ok(()) => make_names_durable(parent_of(target))?,
            // Another process was faster.
            Err(_) if exists(target) => {}
            Err(error) => return Err(DatasetError::io("put back", &aside)(error)),
        }
    }
    Ok(())
}

/// Removes the predecessors of the dataset at `target` once a power cut can no longer bring them back.
fn clear_beside(target: &Path, partial: &Path, first: &Path) {
    let (is_partial, is_aside) = (exists(partial), exists(first));
    if !(is_partial || is_aside) || make_names_durable(parent_of(target)).is_err() {
        return;
    }
    if is_partial {
        clear(partial);
    }
    if is_aside {
        (0..SET_ASIDE)
            .filter_map(|number| aside_name(target, number))
            .for_each(|aside| clear(&aside));
    }
}

/// The complete dataset that was set aside for `target`, also by an older version.
fn set_aside(target: &Path) -> Option<PathBuf> {
    let prefix = format!(".{}.", target.file_name()?.to_str()?);
    let entries = fs::read_dir(parent_of(target)).ok()?.flatten();
    let mut found: Vec<PathBuf> = entries
        .filter(|entry| {
            let name = entry.file_name();
            let rest = name.to_str().and_then(|name| name.strip_prefix(&prefix));
            rest.is_some_and(|rest| {
                rest == "replaced"
                    || rest.strip_suffix(".replaced").is_some_and(|number| {
                        !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit())
                    })
            })
        })
        .map(|entry| entry.path())
        .filter(|path| !path.is_symlink() && is_dataset(path))
        .collect();
    found.sort();
    found.pop()
}

/// True if a process locks the folder at `partial`, which it is writing.
fn is_at_work(partial: &Path) -> bool {
    matches!(
        File::open(partial).map(|folder| folder.try_lock()),
        Ok(Err(fs::TryLockError::WouldBlock))
    )
}

/// Removes the folder at `path` if it is a leftover of ours that no process uses; otherwise a later call removes it.
pub(crate) fn clear(path: &Path) {
    if !path.is_symlink()
        && let Ok(folder) = File::open(path)
        && folder.try_lock().is_ok()
        && is_same(&folder, path)
        && foreign_entry(path).is_none()
    {
        // The header first: a folder without one is no dataset that could be restored.
        drop(remove(path));
    }
}

/// Removes a dataset, its header first, so that no partial dataset remains.
pub(crate) fn remove(path: &Path) -> io::Result<()> {
    // The target of a link is not removed.
    if path.is_symlink() {
        return Err(io::Error::other("a link, which is not followed; remove it"));
    }
    match fs::remove_file(path.join(layout::HEADER)) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
        _ => {}
    }
    fs::remove_dir_all(path)
}

/// Removes the replaced dataset at `path` if no process reads it; else sets it aside until none does.
pub(crate) fn retire(path: &Path, target: &Path) {
    clear(path);
    if exists(path) {
        drop(move_aside(path, target));
    }
}

/// Renames the folder at `path` to the first free name for predecessors of `target`.
pub(crate) fn move_aside(path: &Path, target: &Path) -> Result<PathBuf, DatasetError> {
    let names = (0..SET_ASIDE).filter_map(|number| aside_name(target, number));
    for aside in names {
        if exists(&aside) {
            clear(&aside);
        }
        if exists(&aside) {
            continue;
        }
        return match fs::rename(path, &aside) {
            Ok(()) => Ok(aside),
            Err(error) => Err(DatasetError::io("set aside", path)(error)),
        };
    }
    Err(DatasetError::Busy {
        path: target.to_owned(),
    })
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

fn exists(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok()
}

/// Exchanges two names atomically; `false` if the file system cannot.
pub(crate) fn exchange(one: &Path, other: &Path) -> io::Result<bool> {
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
