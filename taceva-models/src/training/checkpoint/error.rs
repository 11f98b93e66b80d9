//! Errors of checkpoints.

use std::io;
use std::path::PathBuf;

use taceva_core::{ErrorKind, ModelError};
use taceva_network::NetworkError;

/// Error of writing or resuming a checkpoint.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CheckpointError {
    /// The checkpoint file cannot be written.
    #[error(
        "cannot write checkpoint {}: {source}; the earlier checkpoint is unchanged, and the same training resumes from it",
        taceva_core::shown(path)
    )]
    Write {
        /// Path of the checkpoint file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// The weights cannot be copied from the training device.
    #[error("cannot copy the weights of the training into a checkpoint: {0}")]
    Unread(NetworkError),
    /// The checkpoint file cannot be read.
    #[error("cannot read checkpoint {}: {source}", taceva_core::shown(path))]
    Read {
        /// Path of the checkpoint file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// The checkpoint file is damaged.
    #[error(
        "checkpoint {}: {problem}; remove it to start again",
        taceva_core::shown(path)
    )]
    Damaged {
        /// Path of the checkpoint file.
        path: PathBuf,
        /// Fault of the checkpoint file.
        problem: String,
    },
    /// The checkpoint file belongs to another training run.
    #[error(
        "checkpoint {} belongs to another training run, with other {what}; remove it to start again",
        taceva_core::shown(path)
    )]
    Foreign {
        /// Path of the checkpoint file.
        path: PathBuf,
        /// Differing property of the training runs, such as `settings`.
        what: &'static str,
    },
}

impl From<CheckpointError> for ModelError {
    fn from(error: CheckpointError) -> ModelError {
        let kind = match &error {
            CheckpointError::Write { source, .. } | CheckpointError::Read { source, .. } => {
                match source.kind() {
                    io::ErrorKind::NotFound => ErrorKind::NotFound,
                    io::ErrorKind::PermissionDenied => ErrorKind::PermissionDenied,
                    io::ErrorKind::StorageFull => ErrorKind::OutOfRange,
                    _ => ErrorKind::DeviceFault,
                }
            }
            CheckpointError::Unread(_) => ErrorKind::DeviceFault,
            CheckpointError::Damaged { .. } => ErrorKind::Protocol,
            CheckpointError::Foreign { .. } => ErrorKind::InvalidArgument,
        };
        ModelError::new(kind, error.to_string()).because(error)
    }
}
