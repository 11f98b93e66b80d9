//! Models on disk, written atomically.

use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use crate::model::Model;
use crate::models::Models;
use crate::training::file::error::FormatError;
use crate::training::file::limits::FILE_MAX;

impl Model {
    /// Writes the model to `path` and replaces an existing file. Writes a temporary file first and renames it. A reader therefore sees either the old or the
    /// new model, even after a crash.
    ///
    /// # Errors
    /// [`ModelFileError`] with the path.
    pub fn save(&self, path: &Path) -> Result<(), ModelFileError> {
        let bytes = self.to_bytes().map_err(|source| ModelFileError::Format {
            path: path.into(),
            source,
        })?;
        write_whole(path, &bytes).map_err(|source| ModelFileError::Write {
            path: path.into(),
            source,
        })
    }

    /// Reads the model at `path`. Only built-in models are accepted.
    ///
    /// # Errors
    /// Errors of [`Models::open`].
    pub fn open(path: &Path) -> Result<Model, ModelFileError> {
        Models::builtin().open(path)
    }

    /// Digest of the file that [`save`](Model::save) writes: `sha256:` and 64 hexadecimal digits.
    ///
    /// # Errors
    /// Errors of [`to_bytes`](Model::to_bytes).
    pub fn digest(&self) -> Result<String, FormatError> {
        let digest = Sha256::digest(self.to_bytes()?);
        let digits: String = digest.iter().map(|byte| format!("{byte:02x}")).collect();
        Ok(format!("sha256:{digits}"))
    }
}

impl Models {
    /// Reads and checks the model at `path`. Models of a plugin are loaded by the plugin.
    ///
    /// # Errors
    /// [`ModelFileError`] with the path and the fault.
    pub fn open(&self, path: &Path) -> Result<Model, ModelFileError> {
        let bytes = read_capped(path).map_err(|source| ModelFileError::Read {
            path: path.into(),
            source,
        })?;
        self.read(&bytes).map_err(|source| ModelFileError::Format {
            path: path.into(),
            source,
        })
    }
}

/// Reads the file up to one byte beyond the size limit of a model, so that the caller can reject a larger file.
fn read_capped(path: &Path) -> io::Result<Vec<u8>> {
    // Checks before opening: opening a pipe would block until it has a writer.
    if !fs::metadata(path)?.is_file() {
        return Err(io::Error::other("not a regular file"));
    }
    let mut bytes = Vec::new();
    File::open(path)?
        .take(FILE_MAX + 1)
        .read_to_end(&mut bytes)?;
    Ok(bytes)
}

fn write_whole(path: &Path, bytes: &[u8]) -> io::Result<()> {
    taceva_files::replace(path, |staged| File::create_new(staged)?.write_all(bytes))
}

/// Error of reading or writing a model file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ModelFileError {
    /// The file cannot be read.
    #[error("cannot read model {}: {source}", taceva_core::shown(path))]
    Read {
        /// Path of the file.
        path: PathBuf,
        /// Error of the system.
        source: io::Error,
    },
    /// The file cannot be written.
    #[error("cannot write model {}: {source}", taceva_core::shown(path))]
    Write {
        /// Path of the file.
        path: PathBuf,
        /// Error of the system.
        source: io::Error,
    },
    /// The file contains no valid model, or the model exceeds the limits of a file.
    #[error("model {}: {source}", taceva_core::shown(path))]
    Format {
        /// Path of the file.
        path: PathBuf,
        /// Fault in the content.
        source: FormatError,
    },
}
