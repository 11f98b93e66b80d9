#![doc = include_str!("../README.md")]

use std::fs::{self, File};
use std::io;
use std::path::Path;

/// Replaces the file at `path` by the file that `write` writes to `beside`, a path in the same folder.
///
/// A reader of `path` sees the old or the new file at any time. On return the new file is durable.
///
/// # Errors
/// Errors of `write` and of the file system; `beside` is then removed.
pub fn replace<E: From<io::Error>>(
    path: &Path,
    beside: &Path,
    write: impl FnOnce(&Path) -> Result<(), E>,
) -> Result<(), E> {
    let written = write(beside).and_then(|()| {
        File::open(beside)?.sync_all()?;
        fs::rename(beside, path)?;
        Ok(())
    });
    if written.is_err() {
        // Returns the first error; a remaining file does no harm.
        drop(fs::remove_file(beside));
    }
    written?;
    Ok(sync_folder(parent_of(path))?)
}

/// Syncs the names in `folder` to disk. No-op if folders cannot be opened as files, as on Windows.
///
/// # Errors
/// Errors of the file system.
pub fn sync_folder(folder: &Path) -> io::Result<()> {
    if cfg!(unix) {
        File::open(folder)?.sync_all()?;
    }
    Ok(())
}

/// Folder that contains `path`; `.` for a bare name.
///
/// ```
/// use std::path::Path;
///
/// assert_eq!(taceva_files::parent_of(Path::new("a/b")), Path::new("a"));
/// assert_eq!(taceva_files::parent_of(Path::new("b")), Path::new("."));
/// ```
pub fn parent_of(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_write_that_fails_leaves_the_old_file_and_nothing_beside_it() {
        let folder = tempfile::tempdir().expect("a folder");
        let (path, beside) = (folder.path().join("a"), folder.path().join("b"));
        fs::write(&path, "old").expect("written");
        let failed = replace(&path, &beside, |beside| {
            fs::write(beside, "ne")?;
            Err(io::Error::other("full"))
        });
        assert_eq!(failed.expect_err("full").to_string(), "full");
        assert_eq!(fs::read(&path).expect("there"), b"old");
        assert!(!beside.exists());
        replace(&path, &beside, |beside| fs::write(beside, "new")).expect("written");
        assert_eq!(fs::read(&path).expect("there"), b"new");
    }

    #[test]
    fn a_folder_that_is_not_there_cannot_be_synchronised() {
        let folder = tempfile::tempdir().expect("a folder");
        sync_folder(folder.path()).expect("there");
        assert_eq!(
            sync_folder(&folder.path().join("none")).is_err(),
            cfg!(unix)
        );
    }
}
