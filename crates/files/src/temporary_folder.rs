//! Temporary folders with random names and owner-only access. Leftovers of killed processes are removed.

use std::fs::{self, File, OpenOptions};
use std::io;
use std::path::Path;

use tempfile::TempDir;

/// Marker file of our folders, locked while their process lives.
const MARKER: &str = ".taceva-temporary";
/// Limit of attempts, as another process may remove a folder before it is locked.
const CREATIONS: u32 = 16;

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
    folder: TempDir,
    /// Keeps the lock.
    _marker: File,
}

impl TemporaryFolder {
    /// Creates a folder in `parent` whose name begins with `prefix`. Removes leftovers of the same prefix and owner from killed processes.
    ///
    /// Existing entries are kept: links, folders of other owners, and folders without our marker.
    ///
    /// # Errors
    /// [`io::Error`] of the file system.
    pub fn create(parent: &Path, prefix: &str) -> io::Result<TemporaryFolder> {
        for _ in 0..CREATIONS {
            let mut builder = tempfile::Builder::new();
            #[cfg(unix)]
            builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o700));
            let folder = builder.prefix(prefix).tempdir_in(parent)?;
            let path = folder.path().join(MARKER);
            let marker = OpenOptions::new()
                .write(true)
                .create_new(true)
                .open(&path)?;
            marker.try_lock()?;
            // Another process removed it as a leftover before it was locked.
            if !path.exists() {
                continue;
            }
            clear(parent, prefix, folder.path());
            return Ok(TemporaryFolder {
                folder,
                _marker: marker,
            });
        }
        Err(io::Error::other(
            "a temporary folder vanishes as soon as it is made",
        ))
    }

    /// Path of the folder.
    pub fn path(&self) -> &Path {
        self.folder.path()
    }
}

/// Removes the unlocked folders in `parent` that have the prefix and marker and belong to the owner of `own`.
fn clear(parent: &Path, prefix: &str, own: &Path) {
    let entries = fs::read_dir(parent).into_iter().flatten().flatten();
    for entry in entries {
        let name = entry.file_name();
        let is_like = name.to_str().is_some_and(|name| name.starts_with(prefix));
        // Type of the entry itself, without following links.
        let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
        let path = entry.path();
        if !is_like || !is_folder || path == own || !is_of_owner(&path, own) {
            continue;
        }
        let marker = path.join(MARKER);
        if !fs::symlink_metadata(&marker).is_ok_and(|marker| marker.is_file()) {
            continue;
        }
        if File::open(&marker).is_ok_and(|marker| marker.try_lock().is_ok()) {
            // The next process retries a failed removal.
            drop(fs::remove_dir_all(&path));
        }
    }
}

/// True if both folders have the same owner.
#[cfg(unix)]
fn is_of_owner(path: &Path, own: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let owner = |path: &Path| {
        fs::symlink_metadata(path)
            .map(|metadata| metadata.uid())
            .ok()
    };
    owner(path).is_some() && owner(path) == owner(own)
}

#[cfg(not(unix))]
fn is_of_owner(_path: &Path, _own: &Path) -> bool {
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).expect("listed").flatten();
        let mut names: Vec<String> = entries
            .map(|entry| entry.file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    /// K4.
    #[test]
    fn what_a_killed_process_left_is_cleared_and_what_is_held_is_not() {
        let parent = tempfile::tempdir().expect("a folder");
        let held = TemporaryFolder::create(parent.path(), ".x-").expect("made");
        let killed = parent.path().join(".x-killed");
        fs::create_dir(&killed).expect("made");
        fs::write(killed.join(MARKER), "").expect("written");
        fs::write(killed.join("labels.csv"), "Fz\n").expect("written");
        let second = TemporaryFolder::create(parent.path(), ".x-").expect("made");
        assert!(!killed.exists());
        assert!(held.path().exists() && second.path().exists());
        drop((held, second));
        assert_eq!(names(parent.path()), [""; 0]);
    }

    /// K3.
    #[cfg(unix)]
    #[test]
    fn links_and_folders_without_the_marker_are_never_entered_or_removed() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let parent = tempfile::tempdir().expect("a folder");
        let theirs = tempfile::tempdir().expect("a folder");
        fs::write(theirs.path().join("dataset.toml"), "theirs").expect("written");
        fs::write(theirs.path().join(MARKER), "").expect("written");
        symlink(theirs.path(), parent.path().join(".x-link")).expect("linked");
        let foreign = parent.path().join(".x-foreign");
        fs::create_dir(&foreign).expect("made");
        fs::write(foreign.join("thesis.tex"), "x").expect("written");
        let trap = parent.path().join(".x-trap");
        fs::create_dir(&trap).expect("made");
        symlink(theirs.path().join(MARKER), trap.join(MARKER)).expect("linked");
        let made = TemporaryFolder::create(parent.path(), ".x-").expect("made");
        let mode = fs::metadata(made.path())
            .expect("there")
            .permissions()
            .mode();
        assert_eq!(mode & 0o777, 0o700);
        drop(made);
        assert_eq!(names(parent.path()), [".x-foreign", ".x-link", ".x-trap"]);
        assert_eq!(names(theirs.path()), [MARKER, "dataset.toml"]);
        assert!(foreign.join("thesis.tex").exists());
    }
}
