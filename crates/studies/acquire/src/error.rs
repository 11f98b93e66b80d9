//! Errors of an acquisition.

use std::path::{Path, PathBuf};

use taceva_core::{DriverError, DriverKind, ErrorKind};
use taceva_dataset::DatasetError;
use taceva_drivers::OpenError;
use taceva_models::{FeatureError, SettingError};
use taceva_protocol::{RunError, SceneError, StopCause, TapError};

/// Reasons why an acquisition fails or stops.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum AcquireError {
    /// The recording cannot be read or written.
    #[error(transparent)]
    Dataset(#[from] DatasetError),
    /// Frames cannot be reduced to the size in the scene.
    #[error(transparent)]
    Features(#[from] FeatureError),
    /// No model has this setting.
    #[error(transparent)]
    Setting(#[from] SettingError),
    /// The scene is invalid. The error contains the line.
    #[error(transparent)]
    Scene(Box<SceneError>),
    /// A device did not open.
    #[error("study `{study}`: {source}", study = taceva_core::shown(study))]
    Open {
        /// Name of the study.
        study: String,
        /// Reason why the device did not open.
        source: Box<OpenError>,
    },
    /// A device of a rig file did not open.
    #[error(
        "{}: {device}: {source}; {}",
        taceva_core::shown(rig),
        lister(*device)
    )]
    OpenOfRig {
        /// Name of the rig file.
        rig: String,
        /// Kind of the device.
        device: DriverKind,
        /// Reason why the device did not open.
        source: Box<OpenError>,
    },
    /// A device failed during setup or a check of a rig, or before a capture had stored a frame.
    #[error(transparent)]
    Device(#[from] DriverError),
    /// A run stopped early. Finished presses are recorded. The same study resumes after these presses.
    #[error("study `{study}`: {source}", study = taceva_core::shown(study))]
    Acquisition {
        /// Name of the study.
        study: String,
        /// Cause of the stop, and the position of the robot's tip.
        source: Box<RunError>,
    },
    /// A device of a capture or a preview did not open.
    #[error(transparent)]
    OpenLive(Box<OpenError>),
    /// A device failed during a capture. The earlier frames are a complete recording.
    #[error(
        "{source}; the {} before the failure {} a complete recording in {}",
        taceva_core::counted(*frames, "frame"),
        taceva_core::by_count(*frames, "is", "are"),
        taceva_core::shown(path)
    )]
    CaptureEnded {
        /// Path of the recording.
        path: PathBuf,
        /// Number of frames in the recording.
        frames: u64,
        /// Failure of the device.
        source: Box<DriverError>,
    },
    /// A capture cannot be continued, because writing failed.
    #[error("{source}; {}", kept(path, *frames, *is_whole))]
    CaptureBroken {
        /// Path of the recording.
        path: PathBuf,
        /// Number of frames that are safely on disk.
        frames: u64,
        /// True if the recording of these frames could be closed.
        is_whole: bool,
        /// Failure of the write.
        source: Box<DatasetError>,
    },
    /// A fitted model cannot read the frames of the camera.
    #[error("model {}: {problem}", taceva_core::shown(path))]
    Model {
        /// Path of the model file.
        path: PathBuf,
        /// Reason why the model cannot read the frames.
        problem: String,
    },
    /// The lock of a device cannot be acquired.
    #[error("{}: {problem}", taceva_core::shown(path))]
    RigLock {
        /// Path of the lock file.
        path: PathBuf,
        /// Reason why the lock failed.
        problem: String,
    },
    /// Another run uses a device of the rig file.
    #[error(
        "{}: `{}` is in use by another run: wait until it has ended, or stop it",
        taceva_core::shown(rig),
        taceva_core::shown(device)
    )]
    RigTaken {
        /// Name of the rig file.
        rig: String,
        /// Selector of the device.
        device: String,
    },
    /// The latency cannot be measured from taps of the tip on the gel. The tip was raised again.
    #[error(
        "{}: {source}; nothing was written, and the tip is 1 mm above the gel",
        taceva_core::shown(rig)
    )]
    Taps {
        /// Name of the rig file.
        rig: String,
        /// Reason why the taps failed.
        source: TapError,
    },
    /// The request cannot be fulfilled, or the operator stopped the command.
    #[error("{0}")]
    Request(String),
}

/// Command that lists devices of this kind.
fn lister(device: DriverKind) -> &'static str {
    match device {
        DriverKind::Sensor => "`taceva devices` lists cameras",
        _ => "`taceva devices` lists drivers and devices, `taceva doctor` missing permissions",
    }
}

/// Describes the state of a broken capture, and the command that closes it.
fn kept(path: &Path, frames: u64, is_whole: bool) -> String {
    let path = taceva_core::shown(path);
    let are = taceva_core::by_count(frames, "is", "are");
    let frames = taceva_core::counted(frames, "frame");
    match is_whole {
        true => format!("the {frames} before the failure {are} a complete recording in {path}"),
        false => format!(
            "the {frames} before the failure {are} stored: free disk space, then run taceva capture {path} --close"
        ),
    }
}

impl AcquireError {
    /// Kind of the failure, in the common list of error kinds.
    pub fn kind(&self) -> ErrorKind {
        match self {
            AcquireError::Dataset(error) => error.kind(),
            AcquireError::Open { source, .. }
            | AcquireError::OpenOfRig { source, .. }
            | AcquireError::OpenLive(source) => source.kind(),
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
            AcquireError::Taps { .. } => ErrorKind::DeviceFault,
            _ => ErrorKind::InvalidArgument,
        }
    }

    /// True if a device failed, as opposed to the request or a file operation.
    pub fn is_of_device(&self) -> bool {
        match self {
            AcquireError::Open { source, .. }
            | AcquireError::OpenOfRig { source, .. }
            | AcquireError::OpenLive(source) => {
                matches!(**source, OpenError::Device(_))
            }
            AcquireError::Device(_)
            | AcquireError::CaptureEnded { .. }
            | AcquireError::Taps { .. } => true,
            AcquireError::Acquisition { source, .. } => {
                let cause = &source.cause;
                // An invalid rig file is an error of a file, not of a device.
                !matches!(
                    cause,
                    StopCause::Cancelled | StopCause::Log(_) | StopCause::Rig(_)
                )
            }
            _ => false,
        }
    }

    /// True if the command line is invalid, as opposed to a file.
    pub fn is_usage(&self) -> bool {
        matches!(self, AcquireError::Setting(_) | AcquireError::Request(_))
    }
}

impl From<SceneError> for AcquireError {
    fn from(error: SceneError) -> AcquireError {
        AcquireError::Scene(Box::new(error))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn taps_without_a_latency_are_a_failure_of_devices_and_name_the_place_of_the_tip() {
        let error = AcquireError::Taps {
            rig: "lab.toml".to_owned(),
            source: TapError::OneSpeed { ratio: 1.0 },
        };
        assert!(error.is_of_device() && !error.is_usage());
        let said = error.to_string();
        assert!(
            said.starts_with("lab.toml: the fast taps are 1.00 times"),
            "{said}"
        );
        assert!(said.ends_with("the tip is 1 mm above the gel"), "{said}");
    }
}
