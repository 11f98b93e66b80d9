//! Errors of studies.

use std::path::PathBuf;

use taceva_acquire::AcquireError;
use taceva_core::ErrorKind;
use taceva_evaluate::EvaluateError;

/// Errors of studies.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StudyError {
    /// An error of acquisition.
    #[error(transparent)]
    Acquire(#[from] AcquireError),
    /// An error of evaluation.
    #[error(transparent)]
    Evaluate(#[from] EvaluateError),
    /// The folder of a run cannot be created, read or resumed.
    #[error("{}: {problem}", taceva_core::shown(path))]
    RunFolder {
        /// Path of the run folder, or of a file in it.
        path: PathBuf,
        /// Text with the fault and the expected content.
        problem: String,
    },
}

impl StudyError {
    /// Kind of the error, in the common list of error kinds.
    pub fn kind(&self) -> ErrorKind {
        match self {
            StudyError::Acquire(error) => error.kind(),
            StudyError::Evaluate(error) => error.kind(),
            StudyError::RunFolder { .. } => ErrorKind::InvalidArgument,
        }
    }

    /// True if a device failed. False for invalid input, or a failed file operation.
    pub fn is_of_device(&self) -> bool {
        matches!(self, StudyError::Acquire(error) if error.is_of_device())
    }

    /// True if the command line is invalid. False if a file is.
    pub fn is_usage(&self) -> bool {
        match self {
            StudyError::Acquire(error) => error.is_usage(),
            StudyError::Evaluate(error) => error.is_usage(),
            StudyError::RunFolder { .. } => false,
        }
    }
}
