//! Files that are there whole or not at all, and that a power cut does not take away.

use std::fs::{self, File};
use std::io;
use std::path::Path;

/// Puts what `write` makes of the path `beside` in the place of `path`; both are in one folder.
///
/// A reader of `path` sees what was there or what is new, whatever happens in between; when this returns, the new one lasts.
pub(crate) fn replace<E: From<io::Error>>(
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
        // The first error is reported; a file left behind does no harm.
        let _ = fs::remove_file(beside);
    }
    written?;
    Ok(sync_folder(folder(path))?)
}

/// The folder that `path` names a file of.
pub(crate) fn folder(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

/// Makes names in a folder last; elsewhere than on Unix a folder cannot be opened as a file.
pub(crate) fn sync_folder(folder: &Path) -> io::Result<()> {
    if cfg!(unix) {
        File::open(folder)?.sync_all()?;
    }
    Ok(())
}
