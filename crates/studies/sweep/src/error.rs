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
    /// A sweep file or a recording that cannot be read.
    #[error(transparent)]
    Dataset(#[from] DatasetError),
    /// A model, a setting or a metric that does not exist.
    #[error(transparent)]
    Study(#[from] EvaluateError),
    /// A sweep file that parses but is not valid.
    #[error("{}{}: {problem}", shown(path), line.map_or_else(String::new, |line| format!(", line {line}")))]
    Meaning {
        /// The file.
        path: PathBuf,
        /// The line, if known.
        line: Option<usize>,
        /// The fault, and the accepted form.
        problem: String,
    },
    /// An invalid condition, of `--only` or of a file.
    #[error("`{}`: {problem}", shown(text))]
    Condition {
        /// As typed.
        text: String,
        /// The fault, and the accepted form.
        problem: String,
    },
    /// A file in the folder of a sweep that was not written by this program, or was changed.
    #[error("{}: {problem}", shown(path))]
    Kept {
        /// The file.
        path: PathBuf,
        /// The fault, and the remedy.
        problem: String,
    },
    /// A recording, a table, the sensor file or a plugin that changed after the sweep was planned.
    #[error("{}: {problem}; start the sweep again", shown(path))]
    Changed {
        /// The file, the folder, or the name of the model.
        path: PathBuf,
        /// The change.
        problem: String,
    },
    /// An input or output error.
    #[error("cannot {doing} {}: {source}", shown(path))]
    Io {
        /// The operation that failed.
        doing: &'static str,
        /// The file or folder.
        path: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
    /// The Parquet table that cannot be written.
    #[error(transparent)]
    Table(#[from] TableError),
    /// A command of the scheduler that is missing or failed, with its message.
    #[error("{command}: {words}")]
    Scheduler {
        /// The command: `sbatch`.
        command: &'static str,
        /// The message of the command, or why it could not be started.
        words: String,
    },
}

impl SweepError {
    /// Converts an error of the system into one of this crate.
    pub(crate) fn io(doing: &'static str, path: &Path) -> impl FnOnce(io::Error) -> SweepError {
        let path = path.to_owned();
        move |source| SweepError::Io {
            doing,
            path,
            source,
        }
    }

    /// True if the file or the arguments are wrong; no data was read.
    pub fn is_usage(&self) -> bool {
        match self {
            SweepError::Condition { .. } => true,
            SweepError::Study(error) => error.is_usage(),
            _ => false,
        }
    }
}
