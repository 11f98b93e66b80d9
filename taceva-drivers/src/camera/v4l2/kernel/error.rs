//! Why a camera did not do what it was asked.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

use super::picture::PictureFormat;

/// A call to a camera that failed.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum V4l2Error {
    /// Its file did not open.
    #[error("cannot open {path:?}: {source}")]
    Open {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// A file that is no camera, or one whose frames cannot be shared with it.
    #[error("{path:?} is no camera that streams: {why}")]
    NoCamera {
        /// The file.
        path: PathBuf,
        /// What it lacks.
        why: String,
    },
    /// It gives pictures, and not these.
    #[error("the camera gives no {wanted}; it offers {offered}")]
    Format {
        /// What was asked for.
        wanted: PictureFormat,
        /// What it has instead, in words.
        offered: String,
    },
    /// It has no such rate.
    #[error("the camera gives {found:.3} frames a second, asked for {wanted:.3}")]
    Rate {
        /// Frames a second that were asked for.
        wanted: f64,
        /// Those that it gives.
        found: f64,
    },
    /// Another program holds it.
    #[error("another program has the camera: {doing}")]
    Busy {
        /// What could not be done.
        doing: &'static str,
    },
    /// It was unplugged.
    #[error("the camera is gone: {doing}")]
    Gone {
        /// What could not be done.
        doing: &'static str,
    },
    /// The kernel refused a call.
    #[error("cannot {doing}: {source}")]
    Refused {
        /// What could not be done.
        doing: &'static str,
        /// Why.
        source: io::Error,
    },
}

impl V4l2Error {
    /// The error of a call that was `doing` something.
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
