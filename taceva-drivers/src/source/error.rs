//! Why frames could not be read.

use std::io;
use std::path::{Path, PathBuf};

use taceva_core::{ErrorKind, FrameInfo};

use crate::text;

/// A recording, or one frame of it, that cannot be replayed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SourceError {
    /// The operating system refused.
    #[error("cannot {doing} {}: {source}", shown(path))]
    Io {
        /// What was being done.
        doing: &'static str,
        /// On which file or folder.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A folder that holds nothing to replay.
    #[error(
        "{} holds no frame, expected files that end in .png, .jpg or .jpeg",
        shown(folder)
    )]
    Empty {
        /// The folder.
        folder: PathBuf,
    },
    /// More than is accepted.
    #[error("{} holds more than {most} frames", shown(folder))]
    TooMany {
        /// The folder.
        folder: PathBuf,
        /// How many are accepted.
        most: usize,
    },
    /// A frame that is damaged, too large, or of a kind that cameras do not send.
    #[error("{}: {problem}", shown(path))]
    Frame {
        /// The file.
        path: PathBuf,
        /// What is wrong and what would be accepted.
        problem: String,
    },
    /// A frame that is unlike the first one.
    #[error(
        "{}: a frame of {found}, expected {expected} as the first one is",
        shown(path)
    )]
    Size {
        /// The file.
        path: PathBuf,
        /// Size and format of the first frame.
        expected: FrameInfo,
        /// Size and format of this one.
        found: FrameInfo,
    },
    /// A table of times that does not fit its folder.
    #[error("{}{}: {problem}", shown(path), at(*line))]
    Times {
        /// The table.
        path: PathBuf,
        /// The line, counted from 1, where one is to blame.
        line: Option<u64>,
        /// What is wrong and what would be accepted.
        problem: String,
    },
}

impl SourceError {
    /// What kind of failure it was.
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
