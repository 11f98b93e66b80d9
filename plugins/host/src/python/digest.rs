//! Digest of a Python package, over the names and bytes of its files.

use std::fs;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use super::error::PythonError;
use crate::manifest::Sha256Digest;

/// Maximum number of files of a plugin's package; the next constant is their maximum total size, bytes.
const FILES_MAX: usize = 10_000;
const BYTES_MAX: u64 = 1 << 30;

/// Digest of all files in `folder` except `__pycache__` and hidden files. Unlike a library, a package is not copied before the import, so the digest only
/// describes its state at this time. Imported dependencies are not included.
pub(crate) fn digest(folder: &Path) -> Result<Sha256Digest, PythonError> {
    let mut files = Vec::new();
    list(folder, folder, &mut files)?;
    files.sort();
    let mut hasher = Sha256::new();
    let mut left = BYTES_MAX;
    for file in files {
        let path = folder.join(&file);
        let bytes = fs::read(&path).map_err(|source| PythonError::File { path, source })?;
        left = left
            .checked_sub(bytes.len() as u64)
            .ok_or_else(|| too_much(folder, "1 GiB"))?;
        let name = file.as_os_str().as_encoded_bytes();
        for part in [name, &bytes] {
            hasher.update((part.len() as u64).to_le_bytes());
            hasher.update(part);
        }
    }
    Ok(Sha256Digest(hasher.finalize().into()))
}

fn too_much(folder: &Path, most: &'static str) -> PythonError {
    PythonError::TooMuch {
        folder: folder.to_owned(),
        most,
    }
}

fn list(whole: &Path, folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), PythonError> {
    let failed = |source| PythonError::File {
        path: folder.to_owned(),
        source,
    };
    for entry in fs::read_dir(folder).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        let name = entry.file_name();
        if name == "__pycache__" || name.as_encoded_bytes().starts_with(b".") {
            continue;
        }
        let path = entry.path();
        // Follows links to files, but not to folders, because these could form a cycle.
        if entry.file_type().map_err(failed)?.is_dir() {
            list(whole, &path, files)?;
        } else if path.is_file() {
            files.push(path.strip_prefix(whole).unwrap_or(&path).to_owned());
        }
        if files.len() > FILES_MAX {
            return Err(too_much(whole, "10000 files"));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_package_is_another_one_after_a_change_of_a_byte_or_a_name_and_not_after_it_was_run() {
        let folder = tempfile::tempdir().expect("a folder");
        let write = |name: &str, text: &str| {
            let path = folder.path().join(name);
            fs::create_dir_all(path.parent().expect("in a folder")).expect("room");
            fs::write(path, text).expect("room");
        };
        write("__init__.py", "plugin = None\n");
        write("parts/camera.py", "x = 1\n");
        let first = digest(folder.path()).expect("read");
        write("__pycache__/__init__.cpython-311.pyc", "compiled");
        write(".ruff_cache/x", "cached");
        assert_eq!(digest(folder.path()).expect("read"), first);
        write("parts/camera.py", "x = 2\n");
        let second = digest(folder.path()).expect("read");
        assert_ne!(second, first);
        fs::rename(folder.path().join("parts"), folder.path().join("pieces")).expect("ours");
        assert_ne!(digest(folder.path()).expect("read"), second);
        let error = digest(&folder.path().join("gone")).expect_err("nothing there");
        assert_eq!(error.kind(), taceva_core::ErrorKind::NotFound);
    }

    #[test]
    fn a_package_with_too_many_files_is_rejected_with_the_limit_and_the_remedy() {
        let folder = tempfile::tempdir().expect("a folder");
        for number in 0..=FILES_MAX {
            fs::write(folder.path().join(number.to_string()), "").expect("room");
        }
        let error = digest(folder.path()).expect_err("too many files");
        assert_eq!(error.kind(), taceva_core::ErrorKind::OutOfRange);
        let message = error.to_string();
        for words in [
            "has more than 10000 files",
            "move data and environments out",
        ] {
            assert!(message.contains(words), "{message}");
        }
    }
}
