//! Errors of reading and writing tables.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

use taceva_core::shown as core_shown;

/// Error of reading or writing a table or one of its columns.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// A file that cannot be opened or read.
    #[error("cannot read {}: {source}", core_shown(path))]
    Io {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// A file that cannot be created or written.
    #[error("cannot write {}: {source}", core_shown(path))]
    Write {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// File whose bytes contradict the format, because it is truncated, changed or written incorrectly.
    #[error("{}{place}: {}", core_shown(path), core_shown(problem))]
    Damaged {
        /// Path of the file.
        path: PathBuf,
        /// Location in the file.
        place: Place,
        /// Content found, and content expected.
        problem: String,
    },
    /// Recording that ends before its index, because it was truncated or its recorder did not close it.
    #[error(
        "{}{place}: {}; {} {} before the cut: {remedy}",
        core_shown(path),
        core_shown(problem),
        taceva_core::counted(*messages, "complete message"),
        taceva_core::by_count(*messages, "is", "are")
    )]
    Cut {
        /// Path of the file.
        path: PathBuf,
        /// Location at which the file ends too early.
        place: Place,
        /// Missing content.
        problem: String,
        /// Number of complete messages, which [`Recording::open_to_cut`](crate::Recording::open_to_cut) can read.
        messages: u64,
        /// Command of another program that recovers the complete messages.
        remedy: &'static str,
    },
    /// Content that the format allows but this crate does not read.
    #[error("{}{place}: {}", core_shown(path), core_shown(problem))]
    Unsupported {
        /// Path of the file.
        path: PathBuf,
        /// Location in the file.
        place: Place,
        /// Unsupported content, and the supported alternative.
        problem: String,
    },
    /// Content above the memory limit.
    #[error("{}{place}: {}", core_shown(path), core_shown(problem))]
    TooLarge {
        /// Path of the file.
        path: PathBuf,
        /// Location of the content in the file.
        place: Place,
        /// Size found, and the limit.
        problem: String,
    },
    /// A column, a field or a topic that does not exist.
    #[error(
        "{}: no `{}`, expected one of {}",
        core_shown(path),
        shown(name),
        shown_list(known)
    )]
    Missing {
        /// Path of the file.
        path: PathBuf,
        /// Requested name.
        name: String,
        /// Existing names.
        known: Vec<String>,
    },
    /// A column, an element or a cell of the wrong kind, or a value that cannot be written.
    #[error("{}, `{}`: {}", core_shown(path), shown(name), core_shown(problem))]
    Mismatch {
        /// Path of the file.
        path: PathBuf,
        /// Name of the column, element or cell.
        name: String,
        /// Kind found, and kind expected.
        problem: String,
    },
}

impl TableError {
    /// Path of the file.
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
            | TableError::Cut { path, .. }
            | TableError::Unsupported { path, .. }
            | TableError::TooLarge { path, .. }
            | TableError::Missing { path, .. }
            | TableError::Mismatch { path, .. } => path,
        }
    }
}

/// Location in a file: a byte offset, and the column, topic or record that contains it, if known.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Place {
    /// Byte offset, from 0; `None` if unknown.
    pub byte: Option<u64>,
    /// Column, topic or record; `None` if unknown.
    pub name: Option<String>,
}

impl Place {
    /// Location at byte offset `byte`, from 0.
    pub(crate) fn byte(byte: u64) -> Place {
        Place {
            byte: Some(byte),
            name: None,
        }
    }

    /// Location of the column, topic or record `name`.
    pub(crate) fn of(name: &str) -> Place {
        Place {
            byte: None,
            name: Some(name.to_owned()),
        }
    }

    /// The same location, within the column, topic or record `name`.
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

/// Name from a file, for messages. Control characters are escaped, and the name is cut after 80 characters.
pub(crate) fn shown(name: &str) -> String {
    match name.char_indices().nth(80) {
        Some((end, _)) => format!("{}…", core_shown(&name[..end])),
        None => core_shown(name).to_string(),
    }
}

/// Names for a message: at most the first 40.
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
