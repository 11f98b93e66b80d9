//! Why a sweep cannot be planned, carried out or collected.

use std::io;
use std::path::{Path, PathBuf};

use taceva_core::shown;
use taceva_dataset::DatasetError;
use taceva_evaluate::EvaluateError;
use taceva_tables::TableError;

/// Why a sweep cannot be planned, carried out or collected.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SweepError {
    /// The file of the sweep, or a recording, that cannot be read as it should.
    #[error(transparent)]
    Dataset(#[from] DatasetError),
    /// A model, a setting or a metric that does not exist.
    #[error(transparent)]
    Study(#[from] EvaluateError),
    /// A file of a sweep that parses and cannot be meant.
    #[error("{}{}: {problem}", shown(path), line.map_or_else(String::new, |line| format!(", line {line}")))]
    Meaning {
        /// The file.
        path: PathBuf,
        /// The line, where one can be named.
        line: Option<usize>,
        /// What is wrong, and what would be accepted.
        problem: String,
    },
    /// A condition, of `--only` or of a file, that cannot be meant.
    #[error("`{}`: {problem}", shown(text))]
    Condition {
        /// As typed.
        text: String,
        /// What is wrong, and what would be accepted.
        problem: String,
    },
    /// A file in the folder of a sweep that is not what this program wrote there.
    #[error("{}: {problem}", shown(path))]
    Kept {
        /// The file.
        path: PathBuf,
        /// What is wrong, and what to do.
        problem: String,
    },
    /// A recording, a table, the sensor file or a plugin that is another one than when the sweep was planned.
    #[error("{}: {problem}; start the sweep again", shown(path))]
    Changed {
        /// The file, the folder, or the name of the model.
        path: PathBuf,
        /// What is another one.
        problem: String,
    },
    /// The operating system refused.
    #[error("cannot {doing} {}: {source}", shown(path))]
    Io {
        /// What was being done.
        doing: &'static str,
        /// On which file or folder.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The Parquet table that cannot be written.
    #[error(transparent)]
    Table(#[from] TableError),
    /// A command of the scheduler that is absent, or that refused: its words.
    #[error("{command}: {words}")]
    Scheduler {
        /// The command: `sbatch`.
        command: &'static str,
        /// What it said, or why it could not be started.
        words: String,
    },
}

impl SweepError {
    /// What makes an error of the system one of this crate.
    pub(crate) fn io(doing: &'static str, path: &Path) -> impl FnOnce(io::Error) -> SweepError {
        let path = path.to_owned();
        move |source| SweepError::Io {
            doing,
            path,
            source,
        }
    }

    /// Whether the file or the arguments are wrong, and no data was looked at.
    pub fn is_usage(&self) -> bool {
        match self {
            SweepError::Condition { .. } => true,
            SweepError::Study(error) => error.is_usage(),
            _ => false,
        }
    }
}
