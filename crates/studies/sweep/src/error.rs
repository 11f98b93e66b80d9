//! Errors of planning, running and collecting a sweep.

use std::io;
use std::path::{Path, PathBuf};

use taceva_core::shown;
use taceva_dataset::DatasetError;
use taceva_evaluate::EvaluateError;
use taceva_tables::TableError;

/// Errors of planning, running and collecting a sweep.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SweepError {
    /// A sweep file or recording cannot be read.
    #[error(transparent)]
    Dataset(#[from] DatasetError),
    /// An unknown model, setting or metric, or another error of evaluation.
    #[error(transparent)]
    Study(#[from] EvaluateError),
    /// A value in a syntactically valid sweep file is invalid.
    #[error("{}{}: {problem}", shown(path), line.map_or_else(String::new, |line| format!(", line {line}")))]
    Meaning {
        /// Path of the file.
        path: PathBuf,
        /// Line of the value, if known.
        line: Option<usize>,
        /// Description of the fault, and the accepted form.
        problem: String,
    },
    /// A condition in `--only` or in a file is invalid.
    #[error("`{}`: {problem}", shown(text))]
    Condition {
        /// Condition as the user typed it.
        text: String,
        /// Description of the fault, and the accepted form.
        problem: String,
    },
    /// A file in the folder of a sweep was edited, or was not written by this program.
    #[error("{}: {problem}", shown(path))]
    Kept {
        /// Path of the file.
        path: PathBuf,
        /// Description of the fault, and the remedy.
        problem: String,
    },
    /// A recording, a table, the sensor file or a plugin has changed since the sweep was planned.
    #[error("{}: {problem}; start the sweep again", shown(path))]
    Changed {
        /// Path of the file or folder, or name of the model.
        path: PathBuf,
        /// Description of the change.
        problem: String,
    },
    /// An input or output operation failed.
    #[error("cannot {doing} {}: {source}", shown(path))]
    Io {
        /// Operation that failed.
        doing: &'static str,
        /// Path of the file or folder.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// A Parquet table cannot be written.
    #[error(transparent)]
    Table(#[from] TableError),
    /// A command of the scheduler is missing or failed.
    #[error("{command}: {words}")]
    Scheduler {
        /// Name of the command, such as `sbatch`.
        command: &'static str,
        /// Message of the command, or the reason why it did not start.
        words: String,
    },
}

impl SweepError {
    /// Returns a converter from an error of the operating system to [`SweepError`].
    pub(crate) fn io(doing: &'static str, path: &Path) -> impl FnOnce(io::Error) -> SweepError {
        let path = path.to_owned();
        move |source| SweepError::Io {
            doing,
            path,
            source,
        }
    }

    /// True if the user's input is invalid, as opposed to the sweep file or the data.
    pub fn is_usage(&self) -> bool {
        match self {
            SweepError::Condition { .. } => true,
            SweepError::Study(error) => error.is_usage(),
            _ => false,
        }
    }
}
