//! A model on disk: there whole, or not at all.

use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use crate::model::Model;
use crate::models::Models;
use crate::training::file::error::FormatError;
use crate::training::file::limits::FILE_MAX;

impl Model {
    /// Writes the model to `path`, in place of what was there: into a file beside it first, then renamed, so that a
    /// reader sees the old model or the new one whatever happens in between.
    ///
    /// # Errors
    /// [`ModelFileError`], naming the path.
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

    /// Reads the model at `path`, of those that are built in.
    ///
    /// # Errors
    /// As [`Models::open`].
    pub fn open(path: &Path) -> Result<Model, ModelFileError> {
        Models::builtin().open(path)
    }

    /// The digest of the file that [`save`](Model::save) writes, `sha256:` and 64 hexadecimal digits.
    ///
    /// # Errors
    /// [`FormatError`] as [`to_bytes`](Model::to_bytes).
    pub fn digest(&self) -> Result<String, FormatError> {
        let digest = Sha256::digest(self.to_bytes()?);
        let digits: String = digest.iter().map(|byte| format!("{byte:02x}")).collect();
        Ok(format!("sha256:{digits}"))
    }
}

impl Models {
    /// Reads the model at `path`, checking all of it; one of a plugin is loaded by its plugin.
    ///
    /// # Errors
    /// [`ModelFileError`], naming the path and what is wrong there.
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

/// At most one byte more than a model has, which is enough to refuse it.
fn read_capped(path: &Path) -> io::Result<Vec<u8>> {
    // Asked before opening: opening a pipe would wait for whoever writes into it.
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

/// Why a model file cannot be read or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ModelFileError {
    /// The file cannot be read.
    #[error("cannot read model {}: {source}", taceva_core::shown(path))]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The file cannot be written.
    #[error("cannot write model {}: {source}", taceva_core::shown(path))]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The file holds no model, or the model does not fit a file.
    #[error("model {}: {source}", taceva_core::shown(path))]
    Format {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        source: FormatError,
    },
}
