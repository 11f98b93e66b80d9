//! Errors of evaluation.

use std::path::PathBuf;

use taceva_core::{ErrorKind, ModelError};
use taceva_dataset::DatasetError;
use taceva_import::ImportError;
use taceva_metrics::{MetricError, UnknownMetric};
use taceva_models::{FeatureError, FormatError, SettingError, SplitError, UnknownModel};
use taceva_tables::TableError;

/// Errors of evaluation.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EvaluateError {
    /// The dataset cannot be read.
    #[error(transparent)]
    Dataset(#[from] DatasetError),
    /// A table of labels or predictions cannot be read.
    #[error(transparent)]
    Table(#[from] ImportError),
    /// The model cannot be fitted, read or used.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// No model has this name.
    #[error(transparent)]
    UnknownModel(#[from] UnknownModel),
    /// Features cannot be computed from the frames.
    #[error(transparent)]
    Features(#[from] FeatureError),
    /// The model cannot be written to a file.
    #[error(transparent)]
    ModelFormat(#[from] FormatError),
    /// The model cannot be used on the dataset.
    #[error("the model does not suit the dataset: {0}")]
    Unsuited(String),
    /// No model or feature has this setting.
    #[error(transparent)]
    Setting(#[from] SettingError),
    /// The samples cannot be divided as requested.
    #[error(transparent)]
    Split(#[from] SplitError),
    /// No metric has this name.
    #[error(transparent)]
    Metric(#[from] UnknownMetric),
    /// A metric rejects the samples.
    #[error("cannot score: {0}")]
    Scores(#[from] MetricError),
    /// The recording has no samples.
    #[error("{}: the dataset has 0 rows", taceva_core::shown(path))]
    NoSamples {
        /// Path of the dataset.
        path: PathBuf,
    },
    /// Two tables do not belong together.
    #[error("{}: {problem}", taceva_core::shown(path))]
    Tables {
        /// Path of the table that does not match the other.
        path: PathBuf,
        /// Description of the mismatch, and the expected content.
        problem: String,
    },
    /// A Parquet table of scores cannot be read.
    #[error(transparent)]
    Parquet(#[from] TableError),
    /// A state file cannot be read or merged with other state files.
    #[error("{}: {problem}", taceva_core::shown(path))]
    State {
        /// Path of the file.
        path: PathBuf,
        /// Description of the fault, and the expected content.
        problem: String,
    },
    /// A folder of a run cannot be created, read or resumed.
    #[error("{}: {problem}", taceva_core::shown(path))]
    RunFolder {
        /// Path of the folder or of a file in it.
        path: PathBuf,
        /// Description of the fault, and the expected content.
        problem: String,
    },
    /// The request cannot be fulfilled.
    #[error("{0}")]
    Request(String),
}

impl EvaluateError {
    /// Kind of the error, in the common list of error kinds.
    pub fn kind(&self) -> ErrorKind {
        match self {
            EvaluateError::Dataset(error) => error.kind(),
            EvaluateError::Table(error) => error.kind(),
            EvaluateError::Model(error) => error.kind(),
            EvaluateError::Tables { .. }
            | EvaluateError::Parquet(_)
            | EvaluateError::State { .. }
            | EvaluateError::Scores(_) => ErrorKind::Protocol,
            _ => ErrorKind::InvalidArgument,
        }
    }

    /// True if the user's input is invalid, as opposed to the data.
    pub fn is_usage(&self) -> bool {
        matches!(
            self,
            EvaluateError::Setting(_)
                | EvaluateError::Dataset(DatasetError::View { .. })
                | EvaluateError::Metric(_)
                | EvaluateError::UnknownModel(_)
                | EvaluateError::Request(_)
                | EvaluateError::Split(
                    SplitError::Kind { .. }
                        | SplitError::Assignment { .. }
                        | SplitError::Twice { .. }
                        | SplitError::ManyFolds { .. }
                        | SplitError::Folds { .. }
                        | SplitError::FewGroups { .. }
                        | SplitError::Sum { .. }
                )
        )
    }
}
