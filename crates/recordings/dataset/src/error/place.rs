//! Location of a fault in a file.

use std::fmt;
use std::path::{Path, PathBuf};

use crate::text::{shown, shown_path};

/// Location in a file.
///
/// ```
/// use taceva_dataset::{DatasetError, SensorFile};
///
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("sensor.toml");
/// std::fs::write(&path, "model = \"DIGIT\"\ncolour = 1\n")?;
/// let Err(DatasetError::Text { place, .. }) = SensorFile::read(&path) else {
///     unreachable!("`colour` is not a key");
/// };
/// assert_eq!((place.line, place.path), (Some(2), path));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[non_exhaustive]
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// Path of the file.
    pub path: PathBuf,
    /// Line, from 1; `None` if the fault has no line.
    pub line: Option<u64>,
    /// Row, from 0, for files without lines; `None` if the fault has no row.
    pub row: Option<u64>,
    /// Column, by name; `None` if the fault has no column.
    pub column: Option<String>,
}

impl Place {
    /// Location of the whole file at `path`.
    pub fn file(path: &Path) -> Place {
        Place {
            path: path.to_owned(),
            ..Place::default()
        }
    }

    /// The same location, in the column called `name`.
    #[must_use]
    pub fn in_column(self, name: impl Into<String>) -> Place {
        Place {
            column: Some(name.into()),
            ..self
        }
    }

    /// The same location, in the row `row`, from 0.
    #[must_use]
    pub fn in_row(self, row: u64) -> Place {
        Place {
            row: Some(row),
            ..self
        }
    }

    /// The same location without a row.
    pub fn without_row(self) -> Place {
        Place { row: None, ..self }
    }

    /// Location of a line of the file at `path`.
    pub fn line(path: &Path, line: u64) -> Place {
        Place {
            line: Some(line),
            ..Place::file(path)
        }
    }
}

/// Location of the whole file at a path.
impl<P: AsRef<Path> + ?Sized> From<&P> for Place {
    fn from(path: &P) -> Place {
        Place::file(path.as_ref())
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
