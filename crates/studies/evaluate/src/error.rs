//! Why nothing is evaluated.

use std::path::PathBuf;

use taceva_core::{ErrorKind, ModelError};
use taceva_dataset::DatasetError;
use taceva_metrics::{MetricError, UnknownMetric};
use taceva_models::{FeatureError, FormatError, SettingError, SplitError, UnknownModel};
use taceva_tables::TableError;

/// Why nothing is evaluated.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EvaluateError {
    /// The dataset or a table cannot be read as it should.
    #[error(transparent)]
    Dataset(#[from] DatasetError),
    /// The model cannot be fitted, read or used.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A model that does not exist.
    #[error(transparent)]
    UnknownModel(#[from] UnknownModel),
    /// Features that cannot be taken from these frames.
    #[error(transparent)]
    Features(#[from] FeatureError),
    /// A model that cannot be written down.
    #[error(transparent)]
    ModelFormat(#[from] FormatError),
    /// A model that does not suit the dataset.
    #[error("the model does not suit the dataset: {0}")]
    Unsuited(String),
    /// A setting that no model or feature has.
    #[error(transparent)]
    Setting(#[from] SettingError),
    /// Samples cannot be divided as asked.
    #[error(transparent)]
    Split(#[from] SplitError),
    /// A metric that does not exist.
    #[error(transparent)]
    Metric(#[from] UnknownMetric),
    /// Samples that a metric cannot take.
    #[error("cannot score: {0}")]
    Scores(#[from] MetricError),
    /// A recording that holds nothing.
    #[error("{}: no sample: the dataset has 0 rows", taceva_core::shown(path))]
    NoSamples {
        /// The dataset.
        path: PathBuf,
    },
    /// Two tables that do not belong together.
    #[error("{}: {problem}", taceva_core::shown(path))]
    Tables {
        /// The table that does not fit the other.
        path: PathBuf,
        /// What does not fit, and what was expected.
        problem: String,
    },
    /// A Parquet table of scores that cannot be read.
    #[error(transparent)]
    Parquet(#[from] TableError),
    /// A state file that cannot be read, or not be joined with the others.
    #[error("{}: {problem}", taceva_core::shown(path))]
    State {
        /// The file.
        path: PathBuf,
        /// What is wrong with it, and what was expected.
        problem: String,
    },
    /// A folder of a run that cannot be made, read or gone on with.
    #[error("{}: {problem}", taceva_core::shown(path))]
    RunFolder {
        /// The folder or a file in it.
        path: PathBuf,
        /// What is wrong, and what was expected.
        problem: String,
    },
    /// Something was asked for that the dataset or the model does not have.
    #[error("{0}")]
    Request(String),
}

impl EvaluateError {
    /// What kind of failure it was, by the closed list that every part shares.
    pub fn kind(&self) -> ErrorKind {
        match self {
            EvaluateError::Dataset(error) => error.kind(),
            EvaluateError::Model(error) => error.kind(),
            EvaluateError::Tables { .. }
            | EvaluateError::Parquet(_)
            | EvaluateError::State { .. }
            | EvaluateError::Scores(_) => ErrorKind::Protocol,
            _ => ErrorKind::InvalidArgument,
        }
    }

    /// Whether what was typed is at fault, rather than what was read.
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
