//! Why a checkpoint cannot be written or resumed from.

use std::io;
use std::path::PathBuf;

use taceva_core::{ErrorKind, ModelError};
use taceva_network::NetworkError;

/// Why a checkpoint cannot be written or resumed from.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CheckpointError {
    /// The file cannot be written.
    #[error(
        "cannot write checkpoint {}: {source}; what was there before stands, and the same training goes on from it",
        taceva_core::shown(path)
    )]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The device that trains does not give its weights.
    #[error("cannot take the weights of the training for a checkpoint: {0}")]
    Unread(NetworkError),
    /// The file cannot be read.
    #[error("cannot read checkpoint {}: {source}", taceva_core::shown(path))]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The file is not what was written.
    #[error(
        "checkpoint {}: {problem}; remove it to begin anew",
        taceva_core::shown(path)
    )]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        problem: String,
    },
    /// The file is of another training.
    #[error(
        "checkpoint {} is of another training, with other {what}; remove it to begin anew",
        taceva_core::shown(path)
    )]
    Foreign {
        /// The file.
        path: PathBuf,
        /// What differs.
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
