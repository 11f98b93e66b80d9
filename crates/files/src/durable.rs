#![doc = include_str!("../README.md")]

use std::fs::File;
use std::io;
use std::path::Path;

/// Syncs the directory entries of `folder` to disk. Does nothing on systems that cannot open a folder as a file, such as Windows.
///
/// # Errors
/// Errors of the file system.
pub fn sync_folder(folder: &Path) -> io::Result<()> {
    if cfg!(unix) {
        File::open(folder)?.sync_all()?;
    }
    Ok(())
}

/// Parent folder of `path`; `.` for a file name without a folder.
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
    fn a_folder_that_is_not_there_cannot_be_synchronised() {
        let folder = tempfile::tempdir().expect("a folder");
        sync_folder(folder.path()).expect("there");
        assert_eq!(
            sync_folder(&folder.path().join("none")).is_err(),
            cfg!(unix)
        );
    }
}
