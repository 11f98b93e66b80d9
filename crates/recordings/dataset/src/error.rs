//! Why a recording, a table or a map could not be read or written.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

use taceva_core::{ErrorKind, SinkError};
use taceva_files::seal::SealError;

use crate::digest::Digest;
use crate::text::{shown, shown_path};
use crate::version::Version;
use crate::view_names::wanted_view;

/// Everything that can go wrong with data on disk; each variant says what was met, where, and what would be accepted.
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
    /// The operating system refused.
    #[error("cannot {doing} {}: {source}", shown_path(path))]
    Io {
        /// What was being done: `read`, `create`, `make durable`, …
        doing: &'static str,
        /// On which file or folder.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A map, a header or another TOML file that does not say what it must.
    #[error("{place}: {problem}")]
    Toml {
        /// Where.
        place: Place,
        /// What is wrong and what would be accepted.
        problem: String,
    },
    /// A table of labels that cannot be read as one.
    #[error("{place}: {problem}")]
    Table {
        /// Where.
        place: Place,
        /// What is wrong and what would be accepted.
        problem: String,
    },
    /// A path that a foreign file names and that is not followed.
    #[error("{}`{}`: {problem}", named_by(place), shown(written))]
    Path {
        /// Where the path is written.
        place: Option<Box<Place>>,
        /// The path as written.
        written: String,
        /// Why it is not followed.
        problem: String,
    },
    /// An image, or an array of images, that is damaged, too large or unlike the others.
    #[error("{}{problem}", image_at(place, path))]
    Image {
        /// Where the image is named.
        place: Option<Box<Place>>,
        /// The image.
        path: PathBuf,
        /// What is wrong and what would be accepted.
        problem: String,
    },
    /// Something is already there; it is not written over.
    #[error(
        "{} exists already; choose another place or remove it",
        shown_path(path)
    )]
    TargetExists {
        /// What is there.
        path: PathBuf,
    },
    /// Another process is writing there.
    #[error("{} is being written by another process", shown_path(path))]
    Busy {
        /// Where.
        path: PathBuf,
    },
    /// A folder that is no dataset.
    #[error("{} is no dataset: {problem}", shown_path(path))]
    NoDataset {
        /// The folder.
        path: PathBuf,
        /// What is missing.
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
    /// A file whose bytes are not those that were recorded.
    #[error("{}: damaged: expected {expected}, found {found}", shown_path(path))]
    Digest {
        /// The file.
        path: PathBuf,
        /// The digest that was recorded.
        expected: Digest,
        /// The digest of what is there.
        found: Digest,
    },
    /// A header that is not what it was when it was sealed.
    #[error("{}: {source}", shown_path(path))]
    Seal {
        /// The header.
        path: PathBuf,
        /// What is wrong.
        source: SealError,
    },
    /// A file of a dataset that contradicts itself or its header.
    #[error("{}: damaged: {problem}", shown_path(path))]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What does not fit.
        problem: String,
    },
    /// A journal whose middle is damaged: what follows was recorded and must not be cut away.
    #[error("{}: damaged at byte {offset}: {problem}", shown_path(path))]
    Journal {
        /// The journal.
        path: PathBuf,
        /// Where the damaged record begins.
        offset: u64,
        /// What does not fit.
        problem: String,
    },
    /// A sample that cannot be recorded as it is.
    #[error("sample `{}`: {problem}", shown(id))]
    Sample {
        /// The sample.
        id: String,
        /// Why it is refused.
        problem: String,
    },
    /// The caller asked for what the dataset does not have.
    #[error("{}: {problem}", shown_path(path))]
    Request {
        /// The dataset.
        path: PathBuf,
        /// What was asked for and what there is.
        problem: String,
    },
    /// A view of pictures that is not there, or none named where samples have several pictures.
    #[error("{}: {}", shown_path(path), wanted_view(asked.as_deref(), known))]
    View {
        /// The dataset.
        path: PathBuf,
        /// The view that was asked for; `None` if none was.
        asked: Option<String>,
        /// The views that there are.
        known: Vec<String>,
    },
    /// Two recordings that cannot be taken as one.
    #[error(
        "{} and {} cannot be taken as one recording: {problem}",
        shown_path(one),
        shown_path(other)
    )]
    Unlike {
        /// The first.
        one: PathBuf,
        /// The other.
        other: PathBuf,
        /// The key in which they differ, with the value of each, or that they are the same.
        problem: String,
    },
    /// The work was stopped on request; nothing half-written is left.
    #[error("stopped on request")]
    Cancelled,
    /// The sink of the samples refused one.
    #[error("row {row}: {source}")]
    Sink {
        /// The row of the dataset, from 0.
        row: usize,
        /// Why.
        source: SinkError,
    },
}

impl DatasetError {
    /// The same error, a line higher up: of a table to which a header was added.
    pub fn a_line_above(mut self) -> DatasetError {
        if let DatasetError::Table { place, .. } = &mut self
            && let Some(line) = &mut place.line
        {
            *line = line.saturating_sub(1).max(1);
        }
        self
    }

    /// The same error, so many lines further down: of a part of a table that has only its header before it.
    pub fn lines_below(mut self, lines: u64) -> DatasetError {
        if let DatasetError::Table { place, .. } = &mut self
            && let Some(line) = &mut place.line
            && *line > 1
        {
            *line += lines;
        }
        self
    }

    /// What kind of failure it was, by the closed list that every part shares.
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
            DatasetError::Toml { .. }
            | DatasetError::Table { .. }
            | DatasetError::Image { .. }
            | DatasetError::Digest { .. }
            | DatasetError::Damaged { .. }
            | DatasetError::Seal { .. }
            | DatasetError::Journal { .. } => ErrorKind::Protocol,
            DatasetError::Cancelled => ErrorKind::Interrupted,
            DatasetError::Sink { .. } => ErrorKind::Internal,
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

    /// The same error with other paths: `path` makes one of each, `text` of what is said of them.
    pub fn with_paths(
        mut self,
        path: &dyn Fn(&Path) -> PathBuf,
        text: &dyn Fn(&str) -> String,
    ) -> DatasetError {
        let of_place = |place: &mut Place| place.path = path(&place.path);
        match &mut self {
            DatasetError::Toml { place, problem } | DatasetError::Table { place, problem } => {
                of_place(place);
                *problem = text(problem);
            }
            DatasetError::Path { place, problem, .. } => {
                place.as_deref_mut().into_iter().for_each(of_place);
                *problem = text(problem);
            }
            DatasetError::Image {
                place,
                path: image,
                problem,
            } => {
                place.as_deref_mut().into_iter().for_each(of_place);
                *image = path(image);
                *problem = text(problem);
            }
            DatasetError::Io { path: own, .. }
            | DatasetError::TargetExists { path: own }
            | DatasetError::Busy { path: own }
            | DatasetError::NoDataset { path: own, .. }
            | DatasetError::Damaged { path: own, .. } => *own = path(own),
            _ => {}
        }
        self
    }

    /// The same error, saying where the image or path is named.
    pub fn named_at(mut self, at: Place) -> DatasetError {
        if let DatasetError::Path { place, .. } | DatasetError::Image { place, .. } = &mut self {
            *place = Some(Box::new(at));
        }
        self
    }
}

/// A place in a file.
///
/// ```
/// use taceva_dataset::{DatasetError, SensorFile};
///
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("sensor.toml");
/// std::fs::write(&path, "model = \"DIGIT\"\ncolour = 1\n")?;
/// let Err(DatasetError::Toml { place, .. }) = SensorFile::read(&path) else {
///     unreachable!("`colour` is no key");
/// };
/// assert_eq!((place.line, place.path), (Some(2), path));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[non_exhaustive]
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// The file.
    pub path: PathBuf,
    /// Its line, from 1.
    pub line: Option<u64>,
    /// Its row, from 0, where rows are no lines.
    pub row: Option<u64>,
    /// Its column, by name.
    pub column: Option<String>,
}

impl Place {
    /// The whole of the file at `path`.
    pub fn file(path: &Path) -> Place {
        Place {
            path: path.to_owned(),
            ..Place::default()
        }
    }

    /// The same place, in the column called `name`.
    #[must_use]
    pub fn in_column(self, name: impl Into<String>) -> Place {
        Place {
            column: Some(name.into()),
            ..self
        }
    }

    /// The same place, in the row `row`, from 0.
    #[must_use]
    pub fn in_row(self, row: u64) -> Place {
        Place {
            row: Some(row),
            ..self
        }
    }

    /// The same column of all rows.
    pub fn without_row(self) -> Place {
        Place { row: None, ..self }
    }

    /// A line of the file at `path`.
    pub fn line(path: &Path, line: u64) -> Place {
        Place {
            line: Some(line),
            ..Place::file(path)
        }
    }
}

/// Where a picture is: the place that names it, and its own file where that is another one.
fn image_at(place: &Option<Box<Place>>, path: &Path) -> String {
    match place {
        Some(place) if place.path == path => format!("{place}: "),
        _ => format!("{}{}: ", named_by(place), shown_path(path)),
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&shown_path(&self.path))?;
        if let Some(line) = self.line {
            write!(f, ", line {line}")?;
        }
        if let Some(row) = self.row {
            write!(f, ", row {row}")?;
        }
        if let Some(column) = &self.column {
            write!(f, ", column `{}`", shown(column))?;
        }
        Ok(())
    }
}

/// Why a format is not read, and what to do.
fn unreadable(found: Version) -> String {
    match found.is_earlier() {
        true => "was written by a TacEva before release 0.2.0; make the dataset anew: taceva import FOLDER --map MAP.toml --out DATASET, or record again"
            .to_owned(),
        false => format!(
            "needs a newer TacEva; this one reads up to {}.x",
            Version::CURRENT.major
        ),
    }
}

fn named_by(place: &Option<Box<Place>>) -> String {
    place
        .as_ref()
        .map_or_else(String::new, |place| format!("{place}: "))
}

#[cfg(test)]
mod tests;
