//! What can be wrong with a table of another program.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

use taceva_core::shown as core_shown;

/// Why a table, or a column of it, was not read or not written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// The operating system refused to open or to read a file.
    #[error("cannot read {}: {source}", core_shown(path))]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The operating system refused to make or to write a file.
    #[error("cannot write {}: {source}", core_shown(path))]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// Bytes that contradict the format: cut short, changed, or never written by a program that knew it.
    #[error("{}{place}: {}", core_shown(path), core_shown(problem))]
    Damaged {
        /// The file.
        path: PathBuf,
        /// Where in it.
        place: Place,
        /// What was found, and what was expected.
        problem: String,
    },
    /// What the format allows and this crate does not read.
    #[error("{}{place}: {}", core_shown(path), core_shown(problem))]
    Unsupported {
        /// The file.
        path: PathBuf,
        /// Where in it.
        place: Place,
        /// What is not read, and what would be.
        problem: String,
    },
    /// More than is read into memory at once.
    #[error("{}{place}: {}", core_shown(path), core_shown(problem))]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// Where in it.
        place: Place,
        /// How much there is, and how much is accepted.
        problem: String,
    },
    /// A column, a field or a topic that is not there.
    #[error(
        "{}: no `{}`, there are {}",
        core_shown(path),
        shown(name),
        shown_list(known)
    )]
    Missing {
        /// The file.
        path: PathBuf,
        /// What was asked for.
        name: String,
        /// What there is.
        known: Vec<String>,
    },
    /// A column, a place in it or a cell that is not what was asked for, or a value that cannot be written.
    #[error("{}, `{}`: {}", core_shown(path), shown(name), core_shown(problem))]
    Mismatch {
        /// The file.
        path: PathBuf,
        /// What was asked for.
        name: String,
        /// What it is, and what was expected.
        problem: String,
    },
}

impl TableError {
    /// The file that the error is about.
    ///
    /// ```
    /// use taceva_tables::ParquetTable;
    /// let error = ParquetTable::open("absent.parquet".as_ref()).unwrap_err();
    /// assert_eq!(error.path().to_str(), Some("absent.parquet"));
    /// ```
    pub fn path(&self) -> &Path {
        match self {
            TableError::Io { path, .. }
            | TableError::Write { path, .. }
            | TableError::Damaged { path, .. }
            | TableError::Unsupported { path, .. }
            | TableError::TooLarge { path, .. }
            | TableError::Missing { path, .. }
            | TableError::Mismatch { path, .. } => path,
        }
    }
}

/// Where in a file: a byte, and the column, topic or record that it belongs to, as far as known.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Place {
    /// The byte, from 0.
    pub byte: Option<u64>,
    /// The column, topic or record.
    pub name: Option<String>,
}

impl Place {
    /// The byte at `byte`, from 0.
    pub(crate) fn byte(byte: u64) -> Place {
        Place {
            byte: Some(byte),
            name: None,
        }
    }

    /// The column, topic or record called `name`.
    pub(crate) fn of(name: &str) -> Place {
        Place {
            byte: None,
            name: Some(name.to_owned()),
        }
    }

    /// This place, in the column, topic or record called `name`.
    pub(crate) fn in_name(self, name: &str) -> Place {
        Place {
            name: Some(name.to_owned()),
            ..self
        }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(byte) = self.byte {
            write!(f, ", byte {byte}")?;
        }
        match &self.name {
            Some(name) => write!(f, ", `{}`", shown(name)),
            None => Ok(()),
        }
    }
}

/// A name from a file as a message shows it: nothing in it that a terminal obeys, at most 80 characters.
pub(crate) fn shown(name: &str) -> String {
    match name.char_indices().nth(80) {
        Some((end, _)) => format!("{}…", core_shown(&name[..end])),
        None => core_shown(name).to_string(),
    }
}

/// Names as a message lists them: the first 40.
fn shown_list(names: &[String]) -> String {
    if names.is_empty() {
        return "none".to_owned();
    }
    let mut list: Vec<String> = names.iter().take(40).map(|name| shown(name)).collect();
    if names.len() > 40 {
        list.push(format!("and {} more", names.len() - 40));
    }
    list.join(", ")
}
