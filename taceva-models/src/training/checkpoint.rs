//! Training checkpoints on disk. After a power cut, training resumes from the last checkpoint with the same result.

mod bytes;
mod error;
mod identity;

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use taceva_network::{Checkpoint, Trainer};

pub use error::CheckpointError;
pub(crate) use identity::Identity;

/// Location and interval of the checkpoints of a training run.
///
/// Checkpoints do not affect the result. A resumed training gives the same bits as an uninterrupted training.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Checkpoints {
    /// Path of the checkpoint file. A checkpoint is first written to `.<name>.partial` in the same folder, synchronised to disk and renamed.
    pub path: PathBuf,
    /// Minimum interval between checkpoints, checked after each training step. A cancelled training run also writes a checkpoint.
    pub every: Duration,
    /// Action if the checkpoint is damaged or belongs to another training run.
    pub foreign: Foreign,
}

/// Action for a checkpoint that is damaged or belongs to another training run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Foreign {
    /// Keeps the file, and the training fails with an error.
    Refuse,
    /// Starts the training from the beginning, and overwrites the file at the next checkpoint.
    Replace,
}

impl Checkpoints {
    /// Default interval of 30 s. An interruption loses about 30 s of work, and writing takes a small part of the training time.
    pub const EVERY: Duration = Duration::from_secs(30);

    /// Checkpoints at `path`, every [`EVERY`](Checkpoints::EVERY). A checkpoint of another training run is not overwritten.
    pub fn at(path: PathBuf) -> Checkpoints {
        Checkpoints {
            path,
            every: Checkpoints::EVERY,
            foreign: Foreign::Refuse,
        }
    }

    /// Removes the checkpoint. Call this after the model has been saved.
    ///
    /// # Errors
    /// Errors of the operating system, except for a missing file.
    pub fn remove(&self) -> io::Result<()> {
        match fs::remove_file(&self.path) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
            _ => Ok(()),
        }
    }

    /// Reads the checkpoint of the training run `identity`. `None` if there is no file, or if [`foreign`](Checkpoints::foreign) replaces an unusable
    /// file.
    pub(crate) fn take(&self, identity: &Identity) -> Result<Option<Checkpoint>, CheckpointError> {
        let refuse = |problem: String| CheckpointError::Damaged {
            path: self.path.clone(),
            problem,
        };
        let found = read_capped(&self.path).map_err(|source| CheckpointError::Read {
            path: self.path.clone(),
            source,
        })?;
        let Some(found) = found else {
            return Ok(None);
        };
        let replaces = self.foreign == Foreign::Replace;
        match bytes::read(&found) {
            Ok((of, checkpoint)) => match identity.differs_from(&of, &checkpoint.summary) {
                None => Ok(Some(checkpoint)),
                Some(_) if replaces => Ok(None),
                Some(what) => Err(CheckpointError::Foreign {
                    path: self.path.clone(),
                    what,
                }),
            },
            Err(_) if replaces => Ok(None),
            Err(problem) => Err(refuse(problem)),
        }
    }

    /// Writes a checkpoint of `trainer` for the training run `identity`.
    fn put(&self, identity: &Identity, trainer: &Trainer<'_>) -> Result<(), CheckpointError> {
        let checkpoint = trainer.checkpoint().map_err(CheckpointError::Unread)?;
        taceva_files::replace(&self.path, |staged| {
            bytes::write(identity, &checkpoint, File::create(staged)?)
        })
        .map_err(|source| CheckpointError::Write {
            path: self.path.clone(),
            source,
        })
    }
}

/// Checkpoint file of a training run in progress, with the time of the last checkpoint.
pub(crate) struct Shelf<'a> {
    checkpoints: &'a Checkpoints,
    identity: Identity,
    last: Instant,
}

impl<'a> Shelf<'a> {
    pub(crate) fn new(checkpoints: &'a Checkpoints, identity: Identity) -> Shelf<'a> {
        Shelf {
            checkpoints,
            identity,
            last: Instant::now(),
        }
    }

    pub(crate) fn path(&self) -> &Path {
        &self.checkpoints.path
    }

    /// Reads the checkpoint of this training run. `None` if there is no file, or only an unusable file that may be replaced.
    pub(crate) fn take(&self) -> Result<Option<Checkpoint>, CheckpointError> {
        self.checkpoints.take(&self.identity)
    }

    pub(crate) fn put(&mut self, trainer: &Trainer<'_>) -> Result<(), CheckpointError> {
        self.checkpoints.put(&self.identity, trainer)?;
        self.last = Instant::now();
        Ok(())
    }

    /// Writes a checkpoint if the interval has passed.
    pub(crate) fn put_if_due(&mut self, trainer: &Trainer<'_>) -> Result<(), CheckpointError> {
        if self.last.elapsed() >= self.checkpoints.every {
            self.put(trainer)?;
        }
        Ok(())
    }
}

/// Reads at most [`FILE_MAX`](bytes::FILE_MAX) + 1 bytes, so that a larger file can be detected; `None` if there is no file.
fn read_capped(path: &Path) -> io::Result<Option<Vec<u8>>> {
    // Checks before opening: opening a pipe would block until it has a writer.
    match fs::metadata(path) {
        Ok(found) if found.is_file() => {}
        Ok(_) => return Err(io::Error::other("not a regular file")),
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(error),
    }
    let mut found = Vec::new();
    File::open(path)?
        .take(bytes::FILE_MAX + 1)
        .read_to_end(&mut found)?;
    Ok(Some(found))
}
