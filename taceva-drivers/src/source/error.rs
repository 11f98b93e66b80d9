//! Errors of reading recorded frames.

use std::io;
use std::path::{Path, PathBuf};

use taceva_core::{ErrorKind, FrameInfo};

use crate::text;

/// A recording or a frame that cannot be replayed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SourceError {
    /// The operating system reported an error.
    #[error("cannot {doing} {}: {source}", shown(path))]
    Io {
        /// Operation that failed.
        doing: &'static str,
        /// Path of the file or folder.
        path: PathBuf,
        /// Underlying I/O error.
        source: io::Error,
    },
    /// The folder contains no frame.
    #[error(
        "{} holds no frame, expected files that end in .png, .jpg or .jpeg",
        shown(folder)
    )]
    Empty {
        /// Path of the folder.
        folder: PathBuf,
    },
    /// The folder contains too many frames.
    #[error("{} holds more than {most} frames", shown(folder))]
    TooMany {
        /// Path of the folder.
        folder: PathBuf,
        /// Maximum number of frames.
        most: usize,
    },
    /// The file is damaged, too large, not a regular file, or in an unsupported format.
    #[error("{}: {problem}", shown(path))]
    Frame {
        /// Path of the file.
        path: PathBuf,
        /// The fault and the expected value.
        problem: String,
    },
    /// The frame differs in size or format from the first frame.
    #[error(
        "{}: a frame of {found}, expected {expected} like the first frame",
        shown(path)
    )]
    Size {
        /// Path of the file.
        path: PathBuf,
        /// Size and format of the first frame.
        expected: FrameInfo,
        /// Size and format of this frame.
        found: FrameInfo,
    },
    /// The table of times is invalid or does not match its folder.
    #[error("{}{}: {problem}", shown(path), at(*line))]
    Times {
        /// Path of the table.
        path: PathBuf,
        /// Line of the fault, from 1; `None` if the fault has no line.
        line: Option<u64>,
        /// The fault and the expected value.
        problem: String,
    },
}

impl SourceError {
    /// Kind of the failure.
    pub fn kind(&self) -> ErrorKind {
        match self {
            SourceError::Io { source, .. } => match source.kind() {
                io::ErrorKind::NotFound | io::ErrorKind::NotADirectory => ErrorKind::NotFound,
                io::ErrorKind::PermissionDenied => ErrorKind::PermissionDenied,
                _ => ErrorKind::DeviceFault,
            },
            SourceError::Empty { .. } => ErrorKind::NotFound,
            SourceError::TooMany { .. } => ErrorKind::OutOfRange,
            SourceError::Frame { .. } | SourceError::Size { .. } | SourceError::Times { .. } => {
                ErrorKind::Protocol
            }
        }
    }

    pub(super) fn io(doing: &'static str, path: &Path) -> impl FnOnce(io::Error) -> SourceError {
        let path = path.to_owned();
        move |source| SourceError::Io {
            doing,
            path,
            source,
        }
    }
}

fn shown(path: &Path) -> String {
    text::shown(&path.to_string_lossy())
}

fn at(line: Option<u64>) -> String {
    line.map_or_else(String::new, |line| format!(", line {line}"))
}
