//! Errors of recordings, tables and maps.

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

/// Error of data on disk; each variant states the content found, its location, and the accepted form.
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
    /// An error of the operating system.
    #[error("cannot {doing} {}: {source}", shown_path(path))]
    Io {
        /// The operation: `read`, `create`, `make durable`, …
        doing: &'static str,
        /// The file or folder.
        path: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
    /// A text file with invalid content: a map, a header, a table of sessions.
    #[error("{place}: {problem}")]
    Text {
        /// Location.
        place: Place,
        /// The fault, and the accepted form.
        problem: String,
    },
    /// A path that is not followed.
    #[error("`{}`: {problem}", shown(written))]
    Path {
        /// The path as written.
        written: String,
        /// Reason why it is not followed.
        problem: String,
    },
    /// An image, or an array of images, that is damaged, too large or unlike the others.
    #[error("{}: {problem}", shown_path(path))]
    Image {
        /// The image.
        path: PathBuf,
        /// The fault, and the accepted form.
        problem: String,
    },
    /// A target that exists already; it is not overwritten.
    #[error(
        "{} exists already; choose another place or remove it",
        shown_path(path)
    )]
    TargetExists {
        /// The existing path.
        path: PathBuf,
    },
    /// A folder that another process is writing.
    #[error("{} is being written by another process", shown_path(path))]
    Busy {
        /// The folder.
        path: PathBuf,
    },
    /// A folder that is no dataset.
    #[error("{} is no dataset: {problem}", shown_path(path))]
    NoDataset {
        /// The folder.
        path: PathBuf,
        /// The missing part.
        problem: String,
    },
    /// A dataset of a format that this version cannot read.
    #[error("{}: format {found} {}", shown_path(path), unreadable(*found))]
    Version {
        /// The header.
        path: PathBuf,
        /// The format it declares.
        found: Version,
    },
    /// A file whose bytes differ from those recorded.
    #[error("{}: damaged: expected {expected}, found {found}", shown_path(path))]
    Digest {
        /// The file.
        path: PathBuf,
        /// The digest that was recorded.
        expected: Digest,
        /// The digest of the present bytes.
        found: Digest,
    },
    /// A header that was changed after it was sealed.
    #[error("{}: {source}", shown_path(path))]
    Seal {
        /// The header.
        path: PathBuf,
        /// The fault.
        source: SealError,
    },
    /// A file of a dataset that contradicts itself or its header.
    #[error("{}: damaged: {problem}", shown_path(path))]
    Damaged {
        /// The file.
        path: PathBuf,
        /// The contradiction.
        problem: String,
    },
    /// A journal with damage before its end: the later records were acknowledged and must not be cut.
    #[error("{}: damaged at byte {offset}: {problem}", shown_path(path))]
    Journal {
        /// The journal.
        path: PathBuf,
        /// Offset of the damaged record, bytes.
        offset: u64,
        /// The fault.
        problem: String,
    },
    /// A sample that cannot be recorded.
    #[error("sample `{}`: {problem}", shown(id))]
    Sample {
        /// The sample.
        id: String,
        /// The reason.
        problem: String,
    },
    /// A request for something that the dataset lacks.
    #[error("{}: {problem}", shown_path(path))]
    Request {
        /// The dataset.
        path: PathBuf,
        /// The request, and the available alternatives.
        problem: String,
    },
    /// A view of pictures that does not exist, or none named although samples have several pictures.
    #[error("{}: {}", shown_path(path), wanted_view(asked.as_deref(), known))]
    View {
        /// The dataset.
        path: PathBuf,
        /// The requested view; `None` if none was named.
        asked: Option<String>,
        /// The existing views.
        known: Vec<String>,
    },
    /// Two recordings that cannot be joined.
    #[error(
        "{} and {} cannot be joined into one recording: {problem}",
        shown_path(one),
        shown_path(other)
    )]
    Unlike {
        /// The first.
        one: PathBuf,
        /// The other.
        other: PathBuf,
        /// The key in which they differ, with the value of each, or the fact that they are the same.
        problem: String,
    },
    /// The work was cancelled; no partial output is left.
    #[error("stopped on request")]
    Cancelled,
    /// A sample that the sink rejected.
    #[error("row {row}: {source}")]
    Sink {
        /// The row of the dataset, from 0.
        row: usize,
        /// The error of the sink.
        source: SinkError,
    },
}

impl DatasetError {
    /// The kind of the error, from the closed list that all crates share.
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

    /// The path `written`, which is not followed.
    pub fn path(written: impl Into<String>, problem: impl Into<String>) -> DatasetError {
        DatasetError::Path {
            written: written.into(),
            problem: problem.into(),
        }
    }

    /// A fault of the image at `path`.
    pub fn image(path: &Path, problem: impl Into<String>) -> DatasetError {
        DatasetError::Image {
            path: path.to_owned(),
            problem: problem.into(),
        }
    }

    /// A contradiction in the file at `path`, which belongs to a dataset.
    pub fn damaged(path: &Path, problem: impl Into<String>) -> DatasetError {
        DatasetError::Damaged {
            path: path.to_owned(),
            problem: problem.into(),
        }
    }

    /// A request for something that the dataset at `path` lacks.
    pub fn request(path: &Path, problem: impl Into<String>) -> DatasetError {
        DatasetError::Request {
            path: path.to_owned(),
            problem: problem.into(),
        }
    }

    /// The sample `id`, which cannot be recorded.
    pub fn sample(id: &str, problem: impl Into<String>) -> DatasetError {
        DatasetError::Sample {
            id: id.to_owned(),
            problem: problem.into(),
        }
    }

    /// A difference between the bytes of the file at `path` and those recorded.
    pub(crate) fn digest(path: &Path, expected: Digest, found: Digest) -> DatasetError {
        DatasetError::Digest {
            path: path.to_owned(),
            expected,
            found,
        }
    }

    /// An error of the operating system while `doing` something to `path`.
    pub fn io(doing: &'static str, path: &Path) -> impl FnOnce(io::Error) -> DatasetError {
        let path = path.to_owned();
        move |source| DatasetError::Io {
            doing,
            path,
            source,
        }
    }
}

/// The reason why a format is not supported, with the remedy.
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
