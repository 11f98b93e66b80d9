//! Errors of the camera with their reasons.

use super::kernel::V4l2Error;
use taceva_core::{DriverError, ErrorKind};

use super::KEY;

/// What a camera does when it is started.
pub(super) const START: &str = "start the camera";

/// What kind of failure an error of a camera is.
pub(super) fn kind_of(error: &V4l2Error) -> ErrorKind {
    match error {
        V4l2Error::Open { source, .. } => match source.kind() {
            std::io::ErrorKind::PermissionDenied => ErrorKind::PermissionDenied,
            std::io::ErrorKind::ResourceBusy => ErrorKind::Busy,
            _ => ErrorKind::NotFound,
        },
        V4l2Error::NoCamera { .. } => ErrorKind::InvalidArgument,
        V4l2Error::Format { .. } | V4l2Error::Rate { .. } => ErrorKind::Unsupported,
        V4l2Error::Busy { .. } => ErrorKind::Busy,
        V4l2Error::Gone { .. } => ErrorKind::Disconnected,
        _ => ErrorKind::DeviceFault,
    }
}

/// An error of the camera with its reason.
pub(super) fn failed(
    kind: ErrorKind,
    doing: &'static str,
    why: impl Into<Box<dyn std::error::Error + Send + Sync>>,
) -> DriverError {
    DriverError::new(kind, &KEY, doing).because(why)
}

/// What a call to the kernel that failed was for.
pub(super) fn refused(doing: &'static str) -> impl Fn(V4l2Error) -> DriverError {
    move |error| failed(kind_of(&error), doing, error)
}
