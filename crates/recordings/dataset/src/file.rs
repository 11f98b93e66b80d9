//! Foreign files, checked before they are opened, and our own files, written durably.

use std::fs::{self, File, Metadata};
use std::io::{Read, Write};
use std::path::{Component, Path, PathBuf};

use taceva_files::sync_folder;

use crate::error::DatasetError;

/// Opens the regular file at `path`, which may hold at most `cap` bytes; returns how many it holds.
///
/// The kind is looked at before the file is opened: opening a FIFO would wait for ever.
pub(crate) fn open_regular(path: &Path, cap: u64) -> Result<(File, u64), DatasetError> {
    let metadata = fs::metadata(path).map_err(DatasetError::io("read", path))?;
    check_regular(path, &metadata, cap)?;
    let file = File::open(path).map_err(DatasetError::io("open", path))?;
    Ok((file, metadata.len()))
}

/// Whether `path`, whose metadata are `metadata`, is a regular file of at most `cap` bytes.
pub(crate) fn check_regular(
    path: &Path,
    metadata: &Metadata,
    cap: u64,
) -> Result<(), DatasetError> {
    if !metadata.is_file() {
        return Err(DatasetError::Path {
            place: None,
            written: path.to_string_lossy().into_owned(),
            problem: "not a regular file".to_owned(),
        });
    }
    if metadata.len() > cap {
        return Err(DatasetError::Path {
            place: None,
            written: path.to_string_lossy().into_owned(),
            problem: format!(
                "{} bytes, more than the {cap} that are accepted here",
                metadata.len()
            ),
        });
    }
    Ok(())
}

/// The bytes of the regular file at `path`.
pub(crate) fn read_capped(path: &Path, cap: u64) -> Result<Vec<u8>, DatasetError> {
    let (file, length) = open_regular(path, cap)?;
    let mut bytes = Vec::with_capacity(usize::try_from(length).unwrap_or(0));
    file.take(cap)
        .read_to_end(&mut bytes)
        .map_err(DatasetError::io("read", path))?;
    Ok(bytes)
}

/// A foreign folder: paths that lead out of it are refused.
#[derive(Clone, Debug)]
pub(crate) struct SourceFolder {
    /// As the caller wrote it: for messages.
    given: PathBuf,
    /// Without links: for comparison.
    canonical: PathBuf,
}

impl SourceFolder {
    pub(crate) fn open(path: &Path) -> Result<SourceFolder, DatasetError> {
        let canonical = path
            .canonicalize()
            .map_err(DatasetError::io("open", path))?;
        Ok(SourceFolder {
            given: path.to_owned(),
            canonical,
        })
    }

    pub(crate) fn path(&self) -> &Path {
        &self.given
    }

    /// How the file at `path`, and what is called `part` in it, is named in the folder: with `/` on every system.
    pub(crate) fn inside(&self, path: &Path, part: &str) -> String {
        let inside = path.strip_prefix(&self.given).unwrap_or(path);
        let file = inside.to_string_lossy().replace('\\', "/");
        match part.trim_start_matches('/') {
            "" => file,
            part => format!("{file}/{part}"),
        }
    }

    /// The file `relative` to `base`, a folder inside this one.
    pub(crate) fn file(&self, base: &Path, relative: &str) -> Result<PathBuf, DatasetError> {
        let refused = |problem: &str| DatasetError::Path {
            place: None,
            written: relative.to_owned(),
            problem: problem.to_owned(),
        };
        check_relative(relative).map_err(refused)?;
        let path = base.join(relative);
        let canonical = path
            .canonicalize()
            .map_err(|error| refused(&format!("no such file: {error}")))?;
        if !canonical.starts_with(&self.canonical) {
            return Err(refused("leads out of the folder through a link"));
        }
        Ok(path)
    }
}

/// Whether a written path stays inside the folder it is relative to, as far as its text shows.
pub(crate) fn check_relative(written: &str) -> Result<(), &'static str> {
    if written.is_empty() {
        return Err("empty, expected a path relative to the folder");
    }
    if written.contains('\0') {
        return Err("holds a NUL character");
    }
    for component in Path::new(written).components() {
        match component {
            Component::Normal(_) | Component::CurDir => {}
            Component::ParentDir => return Err("`..` is not followed"),
            Component::RootDir | Component::Prefix(_) => {
                return Err("absolute, expected a path relative to the folder");
            }
        }
    }
    Ok(())
}

/// Writes a new file and returns once its bytes are on the disk. Its name is not, until [`make_names_durable`].
pub(crate) fn write_durable(path: &Path, bytes: &[u8]) -> Result<(), DatasetError> {
    let mut file = File::create(path).map_err(DatasetError::io("create", path))?;
    file.write_all(bytes)
        .and_then(|()| file.sync_all())
        .map_err(DatasetError::io("write", path))
}

/// Forces the names in a folder to disk.
pub(crate) fn make_names_durable(folder: &Path) -> Result<(), DatasetError> {
    sync_folder(folder).map_err(DatasetError::io("make durable", folder))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_that_leave_the_folder_by_their_text_are_refused() {
        for bad in ["", "/etc/passwd", "../x", "a/../../x", "a\0b"] {
            assert!(check_relative(bad).is_err(), "{bad:?}");
        }
        for good in ["a", "a/b.png", "./a", "a..b"] {
            assert_eq!(check_relative(good), Ok(()), "{good}");
        }
    }
}
