//! Folders with which tests start. Each is made once and kept in memory, and each test gets a copy.

use std::fs;
use std::path::{Path, PathBuf};

/// The files of a folder.
pub(crate) struct Snapshot(Vec<(PathBuf, Vec<u8>)>);

impl Snapshot {
    pub(crate) fn of(folder: &Path) -> Snapshot {
        let mut files = Vec::new();
        let mut folders = vec![PathBuf::new()];
        while let Some(inner) = folders.pop() {
            for entry in fs::read_dir(folder.join(&inner)).expect("a folder") {
                let entry = entry.expect("readable");
                let path = inner.join(entry.file_name());
                match entry.file_type().expect("known").is_dir() {
                    true => folders.push(path),
                    false => files.push((path, fs::read(entry.path()).expect("bytes"))),
                }
            }
        }
        Snapshot(files)
    }

    /// Writes the files into `folder`.
    pub(crate) fn put(&self, folder: &Path) {
        for (path, bytes) in &self.0 {
            let path = folder.join(path);
            fs::create_dir_all(path.parent().expect("in a folder")).expect("made");
            fs::write(path, bytes).expect("written");
        }
    }
}
