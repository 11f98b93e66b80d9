//! Checkpoints of trainings on disk: after a power cut a training goes on from the last one, and its result is the same.

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

/// Where checkpoints of a training are kept, and how often they are written.
///
/// Nothing of this changes what is learnt: a training that is resumed ends with the same bits as one that was never interrupted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Checkpoints {
    /// The file. It is written beside its place as `.<name>.partial`, forced to disk and renamed.
    pub path: PathBuf,
    /// It is written after the first step that ends so long after the last time, and when the training is stopped on request.
    pub every: Duration,
    /// What is done with a file that another training left.
    pub foreign: Foreign,
}

/// What is done with a checkpoint of another training.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Foreign {
    /// It stays, and the training does not begin.
    Refuse,
    /// It is written over by the next checkpoint.
    Replace,
}

impl Checkpoints {
    /// Every half a minute: what can be lost is short, and writing takes a small part of the time.
    pub const EVERY: Duration = Duration::from_secs(30);

    /// In the file at `path`, every [`EVERY`](Checkpoints::EVERY), never over that of another training.
    pub fn at(path: PathBuf) -> Checkpoints {
        Checkpoints {
            path,
            every: Checkpoints::EVERY,
            foreign: Foreign::Refuse,
        }
    }

    /// Removes the checkpoint, for whoever has the model in a safe place.
    ///
    /// # Errors
    /// Those of the system, but not that there is none.
    pub fn remove(&self) -> io::Result<()> {
        match fs::remove_file(&self.path) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
            _ => Ok(()),
        }
    }

    /// The checkpoint of the training that is `identity`, if it is there.
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

    /// Writes the checkpoint of `trainer`, whose training is `identity`.
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

/// The checkpoint of one training while it goes on.
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

    /// The checkpoint of this training, if there is one.
    pub(crate) fn take(&self) -> Result<Option<Checkpoint>, CheckpointError> {
        self.checkpoints.take(&self.identity)
    }

    pub(crate) fn put(&mut self, trainer: &Trainer<'_>) -> Result<(), CheckpointError> {
        self.checkpoints.put(&self.identity, trainer)?;
        self.last = Instant::now();
        Ok(())
    }

    /// Writes a checkpoint if the last one is old enough.
    pub(crate) fn put_if_due(&mut self, trainer: &Trainer<'_>) -> Result<(), CheckpointError> {
        if self.last.elapsed() >= self.checkpoints.every {
            self.put(trainer)?;
        }
        Ok(())
    }
}

/// The bytes of the file at `path`, at most one more than a checkpoint has; `None` if there is no file.
fn read_capped(path: &Path) -> io::Result<Option<Vec<u8>>> {
    // Asked before opening: opening a pipe would wait for whoever writes into it.
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
