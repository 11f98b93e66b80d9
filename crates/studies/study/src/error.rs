//! Why a study cannot be run.

use std::path::{Path, PathBuf};

use taceva_core::{DriverError, ErrorKind, ModelError};
use taceva_dataset::DatasetError;
use taceva_drivers::OpenError;
use taceva_metrics::{MetricError, UnknownMetric};
use taceva_models::{FeatureError, FormatError, SettingError, SplitError, UnknownModel};
use taceva_protocol::{RunError, SceneError, StopCause};
use taceva_tables::TableError;

/// Why a study cannot be run.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StudyError {
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
    /// A scene that cannot be meant; the error names its line.
    #[error(transparent)]
    Scene(Box<SceneError>),
    /// A device that did not open.
    #[error("study `{study}`: {source}", study = taceva_core::shown(study))]
    Open {
        /// The study.
        study: String,
        /// Why.
        source: Box<OpenError>,
    },
    /// A device failed while a rig was set up or looked at, or before a capture had kept anything.
    #[error(transparent)]
    Device(#[from] DriverError),
    /// A rig that stopped before its end; every press before is recorded, and the same study goes on from there.
    #[error("study `{study}`: {source}", study = taceva_core::shown(study))]
    Acquisition {
        /// The study.
        study: String,
        /// Why, and how the tip was left.
        source: Box<RunError>,
    },
    /// A device of a capture or a preview that did not open.
    #[error(transparent)]
    OpenLive(Box<OpenError>),
    /// A device that failed while a capture was recorded; what came before is whole.
    #[error(
        "{source}; the {frames} frames before are a whole recording in {}",
        taceva_core::shown(path)
    )]
    CaptureEnded {
        /// The recording.
        path: PathBuf,
        /// Frames in it.
        frames: u64,
        /// What ended it.
        source: Box<DriverError>,
    },
    /// A capture that cannot be written any more.
    #[error("{source}; {}", kept(path, *frames, *is_whole))]
    CaptureBroken {
        /// The recording.
        path: PathBuf,
        /// Frames that are durable.
        frames: u64,
        /// Whether what is durable could be closed.
        is_whole: bool,
        /// What could not be written.
        source: Box<DatasetError>,
    },
    /// A folder of a run that cannot be made, read or gone on with.
    #[error("{}: {problem}", taceva_core::shown(path))]
    RunFolder {
        /// The folder or a file in it.
        path: PathBuf,
        /// What is wrong, and what was expected.
        problem: String,
    },
    /// A device of a rig file that another run has.
    #[error(
        "{}: `{}` is in use by another run: wait until it has ended, or stop it",
        taceva_core::shown(rig),
        taceva_core::shown(device)
    )]
    RigTaken {
        /// The rig file.
        rig: String,
        /// What opens the device.
        device: String,
    },
    /// Something was asked for that the dataset or the model does not have.
    #[error("{0}")]
    Request(String),
}

/// What is left of a capture that could not be written on, and what makes it whole.
fn kept(path: &Path, frames: u64, is_whole: bool) -> String {
    let path = taceva_core::shown(path);
    match is_whole {
        true => format!("the {frames} frames before are a whole recording in {path}"),
        false => format!(
            "the {frames} frames before are kept: make room, then run taceva capture {path} --close"
        ),
    }
}

impl StudyError {
    /// What kind of failure it was, by the closed list that every part shares.
    pub fn kind(&self) -> ErrorKind {
        match self {
            StudyError::Dataset(error) => error.kind(),
            StudyError::Model(error) => error.kind(),
            StudyError::Tables { .. }
            | StudyError::Parquet(_)
            | StudyError::State { .. }
            | StudyError::Scores(_) => ErrorKind::Protocol,
            StudyError::Open { source, .. } | StudyError::OpenLive(source) => source.kind(),
            StudyError::Device(error) => error.kind(),
            StudyError::CaptureEnded { source, .. } => source.kind(),
            StudyError::CaptureBroken { source, .. } => source.kind(),
            StudyError::Acquisition { source, .. } => match &source.cause {
                StopCause::Cancelled => ErrorKind::Interrupted,
                StopCause::Device(error) => error.kind(),
                StopCause::Missing(_) => ErrorKind::Unsupported,
                StopCause::Log(_) => ErrorKind::Protocol,
                _ => ErrorKind::DeviceFault,
            },
            _ => ErrorKind::InvalidArgument,
        }
    }

    /// Whether a device failed, rather than what was typed, read or written.
    pub fn is_of_device(&self) -> bool {
        match self {
            StudyError::Open { source, .. } | StudyError::OpenLive(source) => {
                matches!(**source, OpenError::Device(_))
            }
            StudyError::Device(_) | StudyError::CaptureEnded { .. } => true,
            StudyError::Acquisition { source, .. } => {
                let cause = &source.cause;
                // A rig file that is wrong is a file that is wrong.
                !matches!(
                    cause,
                    StopCause::Cancelled | StopCause::Log(_) | StopCause::Rig(_)
                )
            }
            _ => false,
        }
    }

    /// Whether what was typed is at fault, rather than what was read.
    pub fn is_usage(&self) -> bool {
        matches!(
            self,
            StudyError::Setting(_)
                | StudyError::Metric(_)
                | StudyError::UnknownModel(_)
                | StudyError::Request(_)
                | StudyError::Split(
                    SplitError::Kind { .. }
                        | SplitError::Assignment { .. }
                        | SplitError::Twice { .. }
                        | SplitError::ManyFolds
                )
        )
    }
}
