//! Why nothing is acquired, or no more.

use std::path::{Path, PathBuf};

use taceva_core::{DriverError, ErrorKind};
use taceva_dataset::DatasetError;
use taceva_drivers::OpenError;
use taceva_models::{FeatureError, SettingError};
use taceva_protocol::{RunError, SceneError, StopCause};

/// Why nothing is acquired, or no more.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum AcquireError {
    /// The recording cannot be read or written.
    #[error(transparent)]
    Dataset(#[from] DatasetError),
    /// Frames that cannot be reduced as the scene says.
    #[error(transparent)]
    Features(#[from] FeatureError),
    /// A setting that no model has.
    #[error(transparent)]
    Setting(#[from] SettingError),
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
    /// A fitted model that cannot predict what the camera shows.
    #[error("model {}: {problem}", taceva_core::shown(path))]
    Model {
        /// File of the model.
        path: PathBuf,
        /// Why.
        problem: String,
    },
    /// A lock of a device that cannot be taken.
    #[error("{}: {problem}", taceva_core::shown(path))]
    RigLock {
        /// The lock.
        path: PathBuf,
        /// Why.
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

impl AcquireError {
    /// The kind of failure, by the closed list that every part shares.
    pub fn kind(&self) -> ErrorKind {
        match self {
            AcquireError::Dataset(error) => error.kind(),
            AcquireError::Open { source, .. } | AcquireError::OpenLive(source) => source.kind(),
            AcquireError::Device(error) => error.kind(),
            AcquireError::CaptureEnded { source, .. } => source.kind(),
            AcquireError::CaptureBroken { source, .. } => source.kind(),
            AcquireError::Acquisition { source, .. } => match &source.cause {
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
            AcquireError::Open { source, .. } | AcquireError::OpenLive(source) => {
                matches!(**source, OpenError::Device(_))
            }
            AcquireError::Device(_) | AcquireError::CaptureEnded { .. } => true,
            AcquireError::Acquisition { source, .. } => {
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

    /// Whether the command line is at fault, rather than a file.
    pub fn is_usage(&self) -> bool {
        matches!(self, AcquireError::Setting(_) | AcquireError::Request(_))
    }
}

impl From<SceneError> for AcquireError {
    fn from(error: SceneError) -> AcquireError {
        AcquireError::Scene(Box::new(error))
    }
}
