//! Errors of reading and writing recordings, tables and maps.

mod place;

use std::io;
use std::path::{Path, PathBuf};

use taceva_core::{ErrorKind, SinkError};
use taceva_files::seal::SealError;

use crate::digest::Digest;
use crate::text::{shown, shown_path};
use crate::version::Version;
use crate::view_names::wanted_view;

pub use place::Place;

/// Error of data on disk. Each variant states the content found, its location, and the accepted form.
///
/// ```
/// use taceva_core::ErrorKind;
/// use taceva_dataset::{Dataset, DatasetError};
///
/// # let folder = tempfile::tempdir()?;
/// let error = Dataset::open(folder.path()).unwrap_err();
/// assert!(matches!(error, DatasetError::NoDataset { .. }));
/// assert_eq!(error.kind(), ErrorKind::NotFound);
/// # Ok::<(), std::io::Error>(())
/// ```
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DatasetError {
    /// Error of the operating system.
    #[error("cannot {doing} {}: {source}", shown_path(path))]
    Io {
        /// Operation that failed: `read`, `create`, `make durable`, …
        doing: &'static str,
        /// Path of the file or folder.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// Text file with invalid content: an import map, a header, or a table of sessions.
    #[error("{place}: {problem}")]
    Text {
        /// Location of the fault.
        place: Place,
        /// Fault, and the accepted form.
        problem: String,
    },
    /// Path that TacEva must not follow.
    #[error("`{}`: {problem}", shown(written))]
    Path {
        /// Rejected path, as written.
        written: String,
        /// Reason why the path is rejected.
        problem: String,
    },
    /// Image or array of images that is damaged, too large, or differs in size or format from the other images.
    #[error("{}: {problem}", shown_path(path))]
    Image {
        /// Path of the image.
        path: PathBuf,
        /// Fault, and the accepted form.
        problem: String,
    },
    /// Existing target, which is not overwritten.
    #[error(
        "{} exists already; choose another place or remove it",
        shown_path(path)
    )]
    TargetExists {
        /// Path of the target.
        path: PathBuf,
    },
    /// Folder that another process is writing.
    #[error("{} is being written by another process", shown_path(path))]
    Busy {
        /// Path of the folder.
        path: PathBuf,
    },
    /// Folder that is not a dataset.
    #[error("{} is not a dataset: {problem}", shown_path(path))]
    NoDataset {
        /// Path of the folder.
        path: PathBuf,
        /// Missing part of a dataset.
        problem: String,
    },
    /// Dataset in a format version that this build cannot read.
    #[error("{}: format {found} {}", shown_path(path), unreadable(*found))]
    Version {
        /// Path of the header.
        path: PathBuf,
        /// Format declared by the header.
        found: Version,
    },
    /// File whose bytes differ from the recorded bytes.
    #[error("{}: damaged: expected {expected}, found {found}", shown_path(path))]
    Digest {
        /// Path of the file.
        path: PathBuf,
        /// Recorded digest.
        expected: Digest,
        /// Digest of the present bytes.
        found: Digest,
    },
    /// Header that was changed after it was sealed.
    #[error("{}: {source}", shown_path(path))]
    Seal {
        /// Path of the header.
        path: PathBuf,
        /// Fault of the seal.
        source: SealError,
    },
    /// File of a dataset that contradicts itself or its header.
    #[error("{}: damaged: {problem}", shown_path(path))]
    Damaged {
        /// Path of the file.
        path: PathBuf,
        /// Contradiction found.
        problem: String,
    },
    /// Journal that is damaged before its end. Later records were acknowledged and must not be cut.
    #[error("{}: damaged at byte {offset}: {problem}", shown_path(path))]
    Journal {
        /// Path of the journal.
        path: PathBuf,
        /// Offset of the damaged record, bytes.
        offset: u64,
        /// Fault of the record.
        problem: String,
    },
    /// Sample that cannot be recorded.
    #[error("sample `{}`: {problem}", shown(id))]
    Sample {
        /// Name of the sample.
        id: String,
        /// Reason why the sample is rejected.
        problem: String,
    },
    /// Request for something that the dataset lacks.
    #[error("{}: {problem}", shown_path(path))]
    Request {
        /// Path of the dataset.
        path: PathBuf,
        /// Request, and the available alternatives.
        problem: String,
    },
    /// Requested view that does not exist, or a missing selection although samples have several pictures.
    #[error("{}: {}", shown_path(path), wanted_view(asked.as_deref(), known))]
    View {
        /// Path of the dataset.
        path: PathBuf,
        /// Requested view; `None` if none was named.
        asked: Option<String>,
        /// Names of the existing views.
        known: Vec<String>,
    },
    /// Two recordings that cannot be joined.
    #[error(
        "{} and {} cannot be joined into one recording: {problem}",
        shown_path(one),
        shown_path(other)
    )]
    Unlike {
        /// Path of the first recording.
        one: PathBuf,
        /// Path of the second recording.
        other: PathBuf,
        /// Key that differs, with both values, or the statement that both are the same recording.
        problem: String,
    },
    /// Operation that was cancelled; no partial output is left.
    #[error("stopped on request")]
    Cancelled,
    /// Sample that the sink rejected.
    #[error("row {row}: {source}")]
    Sink {
        /// Row of the dataset, from 0.
        row: usize,
        /// Error of the sink.
        source: SinkError,
    },
}

impl DatasetError {
    /// Kind of the error, from the closed list that all crates share.
    pub fn kind(&self) -> ErrorKind {
        match self {
            DatasetError::Io { source, .. } => match source.kind() {
                io::ErrorKind::NotFound => ErrorKind::NotFound,
                io::ErrorKind::PermissionDenied => ErrorKind::PermissionDenied,
                io::ErrorKind::StorageFull => ErrorKind::OutOfRange,
                _ => ErrorKind::DeviceFault,
            },
            DatasetError::NoDataset { .. } => ErrorKind::NotFound,
            DatasetError::Busy { .. } => ErrorKind::Busy,
            DatasetError::Version { .. } => ErrorKind::Unsupported,
            DatasetError::TargetExists { .. }
            | DatasetError::Path { .. }
            | DatasetError::Sample { .. }
            | DatasetError::Unlike { .. }
            | DatasetError::View { .. }
            | DatasetError::Request { .. } => ErrorKind::InvalidArgument,
            DatasetError::Text { .. }
            | DatasetError::Image { .. }
            | DatasetError::Digest { .. }
            | DatasetError::Damaged { .. }
            | DatasetError::Seal { .. }
            | DatasetError::Journal { .. } => ErrorKind::Protocol,
            DatasetError::Cancelled => ErrorKind::Interrupted,
            DatasetError::Sink { .. } => ErrorKind::Internal,
        }
    }

    /// Error for the rejected path `written`.
    pub fn path(written: impl Into<String>, problem: impl Into<String>) -> DatasetError {
        DatasetError::Path {
            written: written.into(),
            problem: problem.into(),
        }
    }

    /// Error for a fault of the image at `path`.
    pub fn image(path: &Path, problem: impl Into<String>) -> DatasetError {
        DatasetError::Image {
            path: path.to_owned(),
            problem: problem.into(),
        }
    }

    /// Error for a contradiction in the file at `path` of a dataset.
    pub fn damaged(path: &Path, problem: impl Into<String>) -> DatasetError {
        DatasetError::Damaged {
            path: path.to_owned(),
            problem: problem.into(),
        }
    }

    /// Error for a request that the dataset at `path` cannot fulfil.
    pub fn request(path: &Path, problem: impl Into<String>) -> DatasetError {
        DatasetError::Request {
            path: path.to_owned(),
            problem: problem.into(),
        }
    }

    /// Error for the sample `id`, which cannot be recorded.
    pub fn sample(id: &str, problem: impl Into<String>) -> DatasetError {
        DatasetError::Sample {
            id: id.to_owned(),
            problem: problem.into(),
        }
    }

    /// Error for a file at `path` whose bytes differ from the recorded bytes.
    pub(crate) fn digest(path: &Path, expected: Digest, found: Digest) -> DatasetError {
        DatasetError::Digest {
            path: path.to_owned(),
            expected,
            found,
        }
    }

    /// Error of the operating system during the operation `doing` on `path`.
    pub fn io(doing: &'static str, path: &Path) -> impl FnOnce(io::Error) -> DatasetError {
        let path = path.to_owned();
        move |source| DatasetError::Io {
            doing,
            path,
            source,
        }
    }
}

/// Reason why a format is not supported, with the remedy.
fn unreadable(found: Version) -> String {
    match found.is_earlier() {
        true => "was written by TacEva before 0.2.0; create the dataset again: taceva import FOLDER --map MAP.toml --out DATASET, or \
            record again"
            .to_owned(),
        false => format!(
            "needs a newer TacEva; this one reads up to {}.x",
            Version::CURRENT.major
        ),
    }
}

#[cfg(test)]
mod tests;
