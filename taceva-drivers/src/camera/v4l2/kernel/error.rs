//! Errors of the kernel interface to a camera.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

use super::picture::PictureFormat;

/// Failure of a kernel call for a camera.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum V4l2Error {
    /// The device file could not be opened.
    #[error("cannot open {path:?}: {source}")]
    Open {
        /// Path of the device file.
        path: PathBuf,
        /// Error that the operating system returned.
        source: io::Error,
    },
    /// The file is not a camera, or the camera does not support streaming.
    #[error("{path:?} is not a streaming camera: {why}")]
    NoCamera {
        /// Path of the device file.
        path: PathBuf,
        /// Capability that the device file lacks, as text.
        why: String,
    },
    /// The camera does not support the requested size or pixel format.
    #[error("the camera does not support {wanted}, expected one of {offered}")]
    Format {
        /// Requested format.
        wanted: PictureFormat,
        /// Formats and sizes that the camera supports, as text.
        offered: String,
    },
    /// The camera does not support the requested rate.
    #[error("the camera gives {found:.3} frames per second, expected {wanted:.3}")]
    Rate {
        /// Requested rate, Hz.
        wanted: f64,
        /// Rate that the camera uses instead, Hz.
        found: f64,
    },
    /// Another program uses the camera.
    #[error("another program uses the camera: cannot {doing}")]
    Busy {
        /// Operation that failed.
        doing: &'static str,
    },
    /// The camera was unplugged.
    #[error("the camera is unplugged: cannot {doing}")]
    Gone {
        /// Operation that failed.
        doing: &'static str,
    },
    /// The kernel rejected a call for another reason.
    #[error("cannot {doing}: {source}")]
    Refused {
        /// Operation that failed.
        doing: &'static str,
        /// Error that the operating system returned.
        source: io::Error,
    },
}

impl V4l2Error {
    /// Converts a system error that occurred during the operation `doing`.
    pub(crate) fn of(doing: &'static str, source: rustix::io::Errno) -> V4l2Error {
        match source {
            rustix::io::Errno::NODEV | rustix::io::Errno::NXIO => V4l2Error::Gone { doing },
            rustix::io::Errno::BUSY => V4l2Error::Busy { doing },
            source => V4l2Error::Refused {
                doing,
                source: source.into(),
            },
        }
    }
}
