//! Errors of imports, exports and tables of labels.

use std::io;
use std::path::{Path, PathBuf};

use taceva_core::ErrorKind;
use taceva_dataset::DatasetError;

pub use taceva_dataset::Place;

/// Creates an [`ImportError::Table`] at a file or a place in a file, with a formatted problem.
macro_rules! table_error {
    ($place:expr, $($problem:tt)+) => {
        $crate::error::ImportError::table($place, format!($($problem)+))
    };
}
pub(crate) use table_error;

/// Error of an import or export, or of a table of labels.
///
/// ```
/// use taceva_core::ErrorKind;
/// use taceva_import::{CsvTable, ImportError};
///
/// let table = CsvTable::of_cells("labels.csv".as_ref(), &["id"], [["1"]])?;
/// let error = table.position("Fz").unwrap_err();
/// assert!(matches!(&error, ImportError::Table { place, .. } if place.path.ends_with("labels.csv")));
/// assert_eq!(error.kind(), ErrorKind::Protocol);
/// # Ok::<(), ImportError>(())
/// ```
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ImportError {
    /// Error of a dataset, of the map or of a source file.
    #[error(transparent)]
    Dataset(#[from] DatasetError),
    /// Error of a path or an image, with the place in a source file that names the path or image.
    #[error("{}", named(place, error))]
    Named {
        /// Place in a source file that names the path or image.
        place: Box<Place>,
        /// Error of the path or image.
        error: Box<DatasetError>,
    },
    /// Table of labels that cannot be read or contradicts its map.
    #[error("{place}: {problem}")]
    Table {
        /// Location of the fault.
        place: Place,
        /// The fault, and the accepted form.
        problem: String,
    },
}

impl ImportError {
    /// The kind of the error, from the closed list that all crates share.
    pub fn kind(&self) -> ErrorKind {
        self.dataset()
            .map_or(ErrorKind::Protocol, DatasetError::kind)
    }

    /// Error of the dataset, the map or the source file; `None` for a fault of a table.
    pub fn dataset(&self) -> Option<&DatasetError> {
        match self {
            ImportError::Table { .. } => None,
            ImportError::Dataset(error) => Some(error),
            ImportError::Named { error, .. } => Some(error),
        }
    }

    pub(crate) fn table(place: impl Into<Place>, problem: impl Into<String>) -> ImportError {
        ImportError::Table {
            place: place.into(),
            problem: problem.into(),
        }
    }

    pub(crate) fn image(path: &Path, problem: impl Into<String>) -> ImportError {
        DatasetError::image(path, problem).into()
    }

    pub(crate) fn path(written: &str, problem: impl Into<String>) -> ImportError {
        DatasetError::path(written, problem).into()
    }

    pub(crate) fn request(path: &Path, problem: impl Into<String>) -> ImportError {
        DatasetError::request(path, problem).into()
    }

    pub(crate) fn io(doing: &'static str, path: &Path) -> impl FnOnce(io::Error) -> ImportError {
        let error = DatasetError::io(doing, path);
        move |source| error(source).into()
    }

    /// The same error with its line number decremented by one, for a table to which a header line was added.
    pub(crate) fn a_line_above(mut self) -> ImportError {
        if let ImportError::Table { place, .. } = &mut self
            && let Some(line) = &mut place.line
        {
            *line = line.saturating_sub(1).max(1);
        }
        self
    }

    /// The same error with its line number increased by `lines`, for a part of a table whose text lacks these lines.
    pub(crate) fn lines_below(mut self, lines: u64) -> ImportError {
        if let ImportError::Table { place, .. } = &mut self
            && let Some(line) = &mut place.line
            && *line > 1
        {
            *line += lines;
        }
        self
    }

    /// The same error with the location where the image or path is named.
    pub(crate) fn named_at(self, place: Place) -> ImportError {
        let error = match self {
            ImportError::Dataset(
                error @ (DatasetError::Path { .. } | DatasetError::Image { .. }),
            ) => Box::new(error),
            ImportError::Named { error, .. } => error,
            other => return other,
        };
        ImportError::Named {
            place: Box::new(place),
            error,
        }
    }

    /// The same error, with `path` applied to each path and `text` to each message.
    pub(crate) fn with_paths(
        mut self,
        path: &dyn Fn(&Path) -> PathBuf,
        text: &dyn Fn(&str) -> String,
    ) -> ImportError {
        let error = match &mut self {
            ImportError::Table { place, problem } => {
                place.path = path(&place.path);
                *problem = text(problem);
                return self;
            }
            ImportError::Dataset(error) => error,
            ImportError::Named { place, error } => {
                place.path = path(&place.path);
                &mut **error
            }
        };
        match error {
            DatasetError::Text { place, problem } => {
                place.path = path(&place.path);
                *problem = text(problem);
            }
            DatasetError::Path { problem, .. } => *problem = text(problem),
            DatasetError::Image { path: own, problem } => {
                *own = path(own);
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
}

/// Message of `error`, preceded by `place`, where its path or image is named. An image path that equals the path of `place` is written once.
fn named(place: &Place, error: &DatasetError) -> String {
    match error {
        DatasetError::Image { path, problem } if *path == place.path => {
            format!("{place}: {problem}")
        }
        error => format!("{place}: {error}"),
    }
}

#[cfg(test)]
mod tests;
