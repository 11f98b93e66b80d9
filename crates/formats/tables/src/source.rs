//! File whose content is not trusted. Each reader opens the file separately, so that threads do not share a cursor.

use std::fs::{self, File};
use std::io::{Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use crate::error::{Place, TableError};

/// Regular file, with its length when first opened.
#[derive(Clone, Debug)]
pub(crate) struct Source {
    path: PathBuf,
    length: u64,
}

impl Source {
    /// Checks the regular file at `path`. Its kind is checked before it is opened, because opening a FIFO blocks.
    pub(crate) fn new(path: &Path) -> Result<Source, TableError> {
        let metadata = fs::metadata(path).map_err(|source| TableError::Io {
            path: path.to_owned(),
            source,
        })?;
        let source = Source {
            path: path.to_owned(),
            length: metadata.len(),
        };
        match metadata.is_file() {
            true => Ok(source),
            false => Err(source.unsupported(Place::default(), "not a regular file")),
        }
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Length of the file, bytes.
    pub(crate) fn length(&self) -> u64 {
        self.length
    }

    /// Opens the file with a separate cursor.
    pub(crate) fn open(&self) -> Result<File, TableError> {
        let file = File::open(&self.path).map_err(|source| self.io(source))?;
        let length = file.metadata().map_err(|source| self.io(source))?.len();
        match length == self.length {
            true => Ok(file),
            false => Err(self.damaged(
                Place::default(),
                format!(
                    "{length} bytes, but the file had {} when it was first opened",
                    self.length
                ),
            )),
        }
    }

    /// Reads `count` bytes from the offset `at`. Rejects bytes beyond the end of the file, or more than `limit`, before memory is allocated.
    pub(crate) fn bytes(
        &self,
        file: &mut File,
        at: u64,
        count: u64,
        limit: u64,
    ) -> Result<Vec<u8>, TableError> {
        let end = at.checked_add(count);
        if end.is_none_or(|end| end > self.length) {
            let problem = format!(
                "{count} bytes are announced here, but the file has {}",
                self.length
            );
            return Err(self.damaged(Place::byte(at), problem));
        }
        if count > limit {
            let problem = format!("{count} bytes at once, at most {limit} are accepted");
            return Err(self.too_large(Place::byte(at), problem));
        }
        let size = usize::try_from(count).map_err(|_| {
            self.too_large(
                Place::byte(at),
                format!("{count} bytes do not fit in memory"),
            )
        })?;
        let mut bytes = vec![0; size];
        file.seek(SeekFrom::Start(at))
            .and_then(|_| file.read_exact(&mut bytes))
            .map_err(|source| self.io(source))?;
        Ok(bytes)
    }

    pub(crate) fn io(&self, source: std::io::Error) -> TableError {
        TableError::Io {
            path: self.path.clone(),
            source,
        }
    }

    pub(crate) fn damaged(&self, place: Place, problem: impl Into<String>) -> TableError {
        TableError::Damaged {
            path: self.path.clone(),
            place,
            problem: problem.into(),
        }
    }

    pub(crate) fn unsupported(&self, place: Place, problem: impl Into<String>) -> TableError {
        TableError::Unsupported {
            path: self.path.clone(),
            place,
            problem: problem.into(),
        }
    }

    pub(crate) fn too_large(&self, place: Place, problem: impl Into<String>) -> TableError {
        TableError::TooLarge {
            path: self.path.clone(),
            place,
            problem: problem.into(),
        }
    }

    pub(crate) fn mismatch(&self, name: &str, problem: impl Into<String>) -> TableError {
        TableError::Mismatch {
            path: self.path.clone(),
            name: name.to_owned(),
            problem: problem.into(),
        }
    }

    pub(crate) fn missing(&self, name: &str, known: Vec<String>) -> TableError {
        TableError::Missing {
            path: self.path.clone(),
            name: name.to_owned(),
            known,
        }
    }
}
