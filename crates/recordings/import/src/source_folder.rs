//! Source folder of an import. Paths outside the folder are rejected.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use taceva_dataset::internal::{check_relative, layout, limits};

use crate::error::ImportError;

/// Source folder. Paths that lead out of the folder are rejected.
#[derive(Clone, Debug)]
pub(crate) struct SourceFolder {
    /// Path as the caller wrote it, for messages.
    given: PathBuf,
    /// Path without links, for comparison.
    canonical: PathBuf,
    /// Paths requested through this handle or any clone of it.
    named: Arc<Mutex<BTreeSet<PathBuf>>>,
}

impl SourceFolder {
    pub(crate) fn open(path: &Path) -> Result<SourceFolder, ImportError> {
        let canonical = path.canonicalize().map_err(ImportError::io("open", path))?;
        Ok(SourceFolder {
            given: path.to_owned(),
            canonical,
            named: Arc::default(),
        })
    }

    pub(crate) fn path(&self) -> &Path {
        &self.given
    }

    /// Path relative to the folder, followed by `part`, with `/` on every operating system.
    pub(crate) fn inside(&self, path: &Path, part: &str) -> String {
        let inside = path.strip_prefix(&self.given).unwrap_or(path);
        let file = inside.to_string_lossy().replace('\\', "/");
        match part.trim_start_matches('/') {
            "" => file,
            part => format!("{file}/{part}"),
        }
    }

    /// Path of the file that `relative` names below `base`, a folder inside the source folder.
    pub(crate) fn file(&self, base: &Path, relative: &str) -> Result<PathBuf, ImportError> {
        let refused = |problem: &str| ImportError::path(relative, problem);
        if relative.is_empty() {
            return Err(refused(
                "empty, expected a path relative to the folder; write `frames_named = [\"\"]` under [drop] to leave out rows without a \
                 picture",
            ));
        }
        check_relative(relative).map_err(refused)?;
        let path = base.join(relative);
        let canonical = path
            .canonicalize()
            .map_err(|error| refused(&format!("no such file: {error}")))?;
        if !canonical.starts_with(&self.canonical) {
            return Err(refused(
                "a link leads out of the folder: copy the folder with the targets of its links (`cp -rL`), or import the folder that \
                 holds both",
            ));
        }
        let mut named = self.named.lock().unwrap_or_else(PoisonError::into_inner);
        named.insert(path.clone());
        drop(named);
        Ok(path)
    }

    /// Requested files, and all files below requested folders.
    pub(crate) fn files_read(&self) -> Vec<PathBuf> {
        let named = self.named.lock().unwrap_or_else(PoisonError::into_inner);
        let files = named.iter().flat_map(|path| match path.is_dir() {
            true => files_below(path),
            false => vec![path.clone()],
        });
        let files: BTreeSet<PathBuf> = files.collect();
        files.into_iter().collect()
    }
}

/// Files below `folder`, sorted by name. Skips datasets and links to folders, and stops above the limit on files.
pub(crate) fn files_below(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
            let path = entry.path();
            match entry.file_type() {
                Ok(kind) if kind.is_dir() && path.join(layout::HEADER).is_file() => {}
                Ok(kind) if kind.is_dir() => folders.push(path),
                Ok(_) if path.is_file() => files.push(path),
                _ => {}
            }
        }
        if files.len() as u64 > limits::WALKED_FILES {
            break;
        }
    }
    files.sort();
    files
}
