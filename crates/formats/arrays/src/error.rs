//! Errors of files of arrays.

use std::ops::Range;
use std::path::PathBuf;

/// Error of reading or writing a file of arrays, or one of its arrays.
///
/// ```
/// use std::path::Path;
/// use taceva_arrays::{ArrayFile, ArrayFormat, Problem};
///
/// let error = ArrayFile::open(Path::new("no/such.npy"), ArrayFormat::Npy).unwrap_err();
/// assert!(matches!(error.problem, Problem::Io { .. }));
/// assert!(error.to_string().starts_with("no/such.npy: cannot open: "));
/// ```
#[derive(Debug, thiserror::Error)]
#[error("{}: {}{problem}", path.display(), array.as_ref().map(|name| format!("`{name}`: ")).unwrap_or_default())]
#[non_exhaustive]
pub struct ArrayError {
    /// The file, or the folder of a zarr store.
    pub path: PathBuf,
    /// The array, if the error concerns one.
    pub array: Option<String>,
    /// The problem.
    #[source]
    pub problem: Problem,
}

/// A problem of a file: its location, and how to fix it. Offsets are in bytes from the beginning of the file, or of the member or chunk
/// that the text names.
///
/// ```
/// use taceva_arrays::Problem;
///
/// let problem = Problem::Rows { asked: 3..9, rows: 5 };
/// assert_eq!(problem.to_string(), "no rows 3 to 9, there are 5 from 0");
/// ```
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Problem {
    /// An input or output error.
    #[error("cannot {doing}: {source}")]
    Io {
        /// The operation that failed.
        doing: &'static str,
        /// The error of the system.
        source: std::io::Error,
    },
    /// Bytes that contradict the format.
    #[error("byte {at}: {found}, expected {expected}")]
    Damaged {
        /// Offset, bytes.
        at: u64,
        /// The content found.
        found: String,
        /// The content expected.
        expected: String,
    },
    /// Content that the format allows but this crate does not read or write.
    #[error("{found}; {mend}")]
    Unsupported {
        /// The content found.
        found: String,
        /// The alternative for the user.
        mend: String,
    },
    /// A size above the limit; nothing was allocated for it.
    #[error("{what}: {size}, above the limit of {limit}")]
    TooLarge {
        /// The thing that is too large, with its unit.
        what: String,
        /// Size in that unit.
        size: u64,
        /// The limit.
        limit: u64,
    },
    /// A checksum of the file that does not match its content.
    #[error(
        "{what}: checksum {computed:#010x}, but the file states {stated:#010x}: the file is damaged"
    )]
    Checksum {
        /// The part of the file.
        what: String,
        /// The checksum in the file.
        stated: u32,
        /// The checksum of its bytes.
        computed: u32,
    },
    /// An inconsistent structure of the file, in the words of the library that reads it.
    #[error("{problem}")]
    Structure {
        /// The message of the library.
        problem: String,
    },
    /// No array of that name.
    #[error("no such array; there are {there}")]
    Absent {
        /// The first names of existing arrays.
        there: String,
    },
    /// Rows beyond the end of the array.
    #[error("no rows {} to {}, there are {rows} from 0", asked.start, asked.end)]
    Rows {
        /// The requested rows, end exclusive.
        asked: Range<u64>,
        /// Number of rows of the array.
        rows: u64,
    },
    /// A pickle that needs a class or function beyond plain values and arrays. No part of it was run.
    #[error("byte {at}: wants `{global}`, which is not run here; {mend}")]
    Global {
        /// Offset, bytes.
        at: u64,
        /// Module and name.
        global: String,
        /// The alternative for the user.
        mend: String,
    },
}

impl Problem {
    pub(crate) fn io(doing: &'static str) -> impl FnOnce(std::io::Error) -> Problem {
        move |source| Problem::Io { doing, source }
    }

    pub(crate) fn damaged(
        at: u64,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) -> Problem {
        Problem::Damaged {
            at,
            found: found.into(),
            expected: expected.into(),
        }
    }

    /// Repeats the problem for a later request; kinds not matched here become `Structure` with the same text.
    pub(crate) fn again(&self) -> Problem {
        match self {
            Problem::Unsupported { found, mend } => {
                Problem::unsupported(found.as_str(), mend.as_str())
            }
            Problem::Damaged {
                at,
                found,
                expected,
            } => Problem::damaged(*at, found.as_str(), expected.as_str()),
            Problem::TooLarge { what, size, limit } => {
                Problem::too_large(what.as_str(), *size, *limit)
            }
            Problem::Global { at, global, mend } => Problem::Global {
                at: *at,
                global: global.clone(),
                mend: mend.clone(),
            },
            other => Problem::Structure {
                problem: other.to_string(),
            },
        }
    }

    /// The same problem, with the part of the file that its offsets refer to.
    pub(crate) fn within(self, part: &str) -> Problem {
        match self {
            Problem::Damaged {
                at,
                found,
                expected,
            } => Problem::Damaged {
                at,
                found: format!("{found} in {part}"),
                expected,
            },
            Problem::Unsupported { found, mend } => Problem::Unsupported {
                found: format!("{part}: {found}"),
                mend,
            },
            other => other,
        }
    }

    pub(crate) fn unsupported(found: impl Into<String>, mend: impl Into<String>) -> Problem {
        Problem::Unsupported {
            found: found.into(),
            mend: mend.into(),
        }
    }

    pub(crate) fn too_large(what: impl Into<String>, size: u64, limit: u64) -> Problem {
        Problem::TooLarge {
            what: what.into(),
            size,
            limit,
        }
    }
}
