//! Source folder of an import, which confines all paths.

use std::path::{Path, PathBuf};

use taceva_dataset::DatasetError;
use taceva_dataset::internal::check_relative;

/// Foreign folder. Paths that leave it are rejected.
#[derive(Clone, Debug)]
pub(crate) struct SourceFolder {
    /// Path as the caller wrote it, for messages.
    given: PathBuf,
    /// Path without links, for comparison.
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

    /// Path relative to the folder, followed by `part`, with `/` on every system.
    pub(crate) fn inside(&self, path: &Path, part: &str) -> String {
        let inside = path.strip_prefix(&self.given).unwrap_or(path);
        let file = inside.to_string_lossy().replace('\\', "/");
        match part.trim_start_matches('/') {
            "" => file,
            part => format!("{file}/{part}"),
        }
    }

    /// Path of the file `relative` to `base`, a folder inside this one.
    pub(crate) fn file(&self, base: &Path, relative: &str) -> Result<PathBuf, DatasetError> {
        let refused = |problem: &str| DatasetError::Path {
            place: None,
            written: relative.to_owned(),
            problem: problem.to_owned(),
        };
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
        Ok(path)
    }
}
