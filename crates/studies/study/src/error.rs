//! Why a study cannot be run.

use std::path::PathBuf;

use taceva_acquire::AcquireError;
use taceva_core::ErrorKind;
use taceva_evaluate::EvaluateError;

/// Why a study cannot be run.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StudyError {
    /// Nothing is acquired, or no more.
    #[error(transparent)]
    Acquire(#[from] AcquireError),
    /// Nothing is evaluated.
    #[error(transparent)]
    Evaluate(#[from] EvaluateError),
    /// A folder of a run that cannot be made, read or gone on with.
    #[error("{}: {problem}", taceva_core::shown(path))]
    RunFolder {
        /// The folder or a file in it.
        path: PathBuf,
        /// What is wrong, and what was expected.
        problem: String,
    },
}

impl StudyError {
    /// The kind of failure, by the closed list that every part shares.
    pub fn kind(&self) -> ErrorKind {
        match self {
            StudyError::Acquire(error) => error.kind(),
            StudyError::Evaluate(error) => error.kind(),
            StudyError::RunFolder { .. } => ErrorKind::InvalidArgument,
        }
    }

    /// Whether a device failed, rather than what was typed, read or written.
    pub fn is_of_device(&self) -> bool {
        matches!(self, StudyError::Acquire(error) if error.is_of_device())
    }

    /// Whether the command line is at fault, rather than a file.
    pub fn is_usage(&self) -> bool {
        match self {
            StudyError::Acquire(error) => error.is_usage(),
            StudyError::Evaluate(error) => error.is_usage(),
            StudyError::RunFolder { .. } => false,
        }
    }
}
