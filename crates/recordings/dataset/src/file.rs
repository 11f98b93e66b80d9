//! Checked opening of input files, and durable writing of output files.

use std::fs::{self, File, Metadata};
use std::io::{ErrorKind, Read, Write};
use std::os::unix::fs::MetadataExt;
use std::path::{Component, Path};

use taceva_files::sync_folder;

use crate::absence::quoted;
use crate::error::DatasetError;

/// Opens the regular file at `path`, of at most `cap` bytes. Returns the file and its size, bytes.
///
/// The file type is checked before opening, because opening a FIFO would block.
pub fn open_regular(path: &Path, cap: u64) -> Result<(File, u64), DatasetError> {
    let metadata = fs::metadata(path).map_err(DatasetError::io("read", path))?;
    check_regular(path, &metadata, cap)?;
    let file = File::open(path).map_err(DatasetError::io("open", path))?;
    Ok((file, metadata.len()))
}

/// Checks that `path` with these `metadata` is a regular file of at most `cap` bytes.
pub(crate) fn check_regular(
    path: &Path,
    metadata: &Metadata,
    cap: u64,
) -> Result<(), DatasetError> {
    if !metadata.is_file() {
        return Err(DatasetError::path(
            path.to_string_lossy(),
            "not a regular file",
        ));
    }
    if metadata.len() > cap {
        return Err(DatasetError::path(
            path.to_string_lossy(),
            format!("{} bytes, expected at most {cap}", metadata.len()),
        ));
    }
    Ok(())
}

/// Bytes of the regular file at `path`.
pub fn read_capped(path: &Path, cap: u64) -> Result<Vec<u8>, DatasetError> {
    let (file, length) = open_regular(path, cap)?;
    let mut bytes = Vec::with_capacity(usize::try_from(length).unwrap_or(0));
    file.take(cap)
        .read_to_end(&mut bytes)
        .map_err(DatasetError::io("read", path))?;
    Ok(bytes)
}

/// Checks that a relative path does not lead out of its folder.
pub fn check_relative(written: &str) -> Result<(), &'static str> {
    if written.is_empty() {
        return Err("empty, expected a path relative to the folder");
    }
    if written.contains('\0') {
        return Err("holds a NUL character");
    }
    for component in Path::new(written).components() {
        match component {
            Component::Normal(_) | Component::CurDir => {}
            Component::ParentDir => return Err("contains `..`, expected a path inside the folder"),
            Component::RootDir | Component::Prefix(_) => {
                return Err("absolute, expected a path relative to the folder");
            }
        }
    }
    Ok(())
}

/// Creates an empty file at `path`. Removes an existing file or link first, so that no link is followed.
pub(crate) fn create_anew(path: &Path) -> Result<File, DatasetError> {
    let created = match File::create_new(path) {
        Err(error) if error.kind() == ErrorKind::AlreadyExists => {
            fs::remove_file(path).map_err(DatasetError::io("remove", path))?;
            File::create_new(path)
        }
        created => created,
    };
    created.map_err(DatasetError::io("create", path))
}

/// Rejects a symbolic link in place of a file of a recording, because its target would be written, truncated or read instead.
pub(crate) fn refuse_link(path: &Path) -> Result<(), DatasetError> {
    let Ok(target) = fs::read_link(path) else {
        return Ok(());
    };
    let target = match path.parent() {
        Some(parent) => parent.join(target),
        None => target,
    };
    let (link, target) = (quoted(path), quoted(&target));
    Err(DatasetError::damaged(
        path,
        format!(
            "a symbolic link to {target}, which no recorder follows: put the target back by `rm {link} && mv {target} {link}`. Or move the whole recording to the disk of the target, replace the link by the target, and name the new path. Remove a link that is not yours"
        ),
    ))
}

/// Writes a new file and returns once its bytes are on disk. The name is durable only after `make_names_durable`.
pub fn write_durable(path: &Path, bytes: &[u8]) -> Result<(), DatasetError> {
    let mut file = create_anew(path)?;
    file.write_all(bytes)
        .and_then(|()| file.sync_all())
        .map_err(DatasetError::io("write", path))
}

/// Syncs the directory entries of a folder to disk.
pub(crate) fn make_names_durable(folder: &Path) -> Result<(), DatasetError> {
    sync_folder(folder).map_err(DatasetError::io("make durable", folder))
}

/// True if `path` still names the open file `held`.
pub(crate) fn is_same(held: &File, path: &Path) -> bool {
    let (Ok(held), Ok(named)) = (held.metadata(), fs::metadata(path)) else {
        return false;
    };
    (held.dev(), held.ino()) == (named.dev(), named.ino())
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
