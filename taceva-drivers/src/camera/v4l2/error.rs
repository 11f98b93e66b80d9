//! Errors of the driver `camera/v4l2`.

use super::kernel::V4l2Error;
use taceva_core::{DriverError, ErrorKind};

use super::KEY;

/// Operation that the error of a failed start names.
pub(super) const START: &str = "start the camera";

/// Kind of the driver error that reports `error` of the kernel interface.
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

/// Creates an error of this driver: `doing` is the operation that failed, `why` the reason.
pub(super) fn failed(
    kind: ErrorKind,
    doing: &'static str,
    why: impl Into<Box<dyn std::error::Error + Send + Sync>>,
) -> DriverError {
    DriverError::new(kind, &KEY, doing).because(why)
}

/// Returns a converter for errors of the kernel interface that occur during the operation `doing`.
pub(super) fn refused(doing: &'static str) -> impl Fn(V4l2Error) -> DriverError {
    move |error| failed(kind_of(&error), doing, error)
}
