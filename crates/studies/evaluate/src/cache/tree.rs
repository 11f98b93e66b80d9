//! Links folders of files instead of copying them.

use std::fs::{self, File};
use std::io;
use std::path::Path;

use taceva_files::sync_folder;

/// Size in bytes below which files are copied. Linking small files saves no space, and copies can be edited independently.
const LINKED: u64 = 1 << 16;

/// Creates the folder `to` with all files of `from`. Large files are linked, or copied if the file system rejects links.
///
/// File names in `to` are durable on return. File contents are as durable as those of `from`.
pub(super) fn link(from: &Path, to: &Path) -> io::Result<()> {
    fs::create_dir(to)?;
    for entry in fs::read_dir(from)? {
        let entry = entry?;
        let (file, target) = (entry.path(), to.join(entry.file_name()));
        if entry.file_type()?.is_dir() {
            link(&file, &target)?;
        } else if entry.metadata()?.len() < LINKED || fs::hard_link(&file, &target).is_err() {
            fs::copy(&file, &target)?;
            File::open(&target)?.sync_all()?;
        }
    }
    sync_folder(to)
}

/// Removes the file or folder at `path`, if it exists.
pub fn remove(path: &Path) -> io::Result<()> {
    let removed = match fs::symlink_metadata(path) {
        Ok(found) if found.is_dir() => fs::remove_dir_all(path),
        Ok(_) => fs::remove_file(path),
        Err(error) => Err(error),
    };
    match removed {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
        other => other,
    }
}
