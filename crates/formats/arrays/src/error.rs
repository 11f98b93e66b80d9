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
    /// File, or folder of a zarr store.
    pub path: PathBuf,
    /// Name of the array, if the error concerns a single array.
    pub array: Option<String>,
    /// Problem with the file or array.
    #[source]
    pub problem: Problem,
}

/// Problem of a file, with its location and a remedy. Offsets are in bytes from the start of the file, or from the start of the member or chunk that the text
/// names.
///
/// ```
/// use taceva_arrays::Problem;
///
/// let problem = Problem::Rows { asked: 3..9, rows: 5 };
/// assert_eq!(problem.to_string(), "rows 3 to 9 were requested, but the array has 5 rows, counted from 0");
/// ```
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Problem {
    /// Error of input or output.
    #[error("cannot {doing}: {source}")]
    Io {
        /// Operation that failed.
        doing: &'static str,
        /// Error of the operating system.
        source: std::io::Error,
    },
    /// Bytes that contradict the format.
    #[error("byte {at}: {found}, expected {expected}")]
    Damaged {
        /// Offset, bytes.
        at: u64,
        /// Found content.
        found: String,
        /// Expected content.
        expected: String,
    },
    /// Content that the format allows but this crate does not read or write.
    #[error("{found}; {mend}")]
    Unsupported {
        /// Found content.
        found: String,
        /// Remedy.
        mend: String,
    },
    /// Size above a limit. No memory was allocated.
    #[error("{what}: {size}, above the limit of {limit}")]
    TooLarge {
        /// Limited quantity, with its unit.
        what: String,
        /// Size in that unit.
        size: u64,
        /// Limit in that unit.
        limit: u64,
    },
    /// Checksum of the file that does not match its content.
    #[error(
        "{what}: checksum {computed:#010x}, but the file states {stated:#010x}: the file is damaged"
    )]
    Checksum {
        /// Part of the file that the checksum covers.
        what: String,
        /// Checksum in the file.
        stated: u32,
        /// Computed checksum of the bytes.
        computed: u32,
    },
    /// Inconsistent structure of the file, with the message of the library that reads it.
    #[error("{problem}")]
    Structure {
        /// Message of the library.
        problem: String,
    },
    /// Array name that does not exist.
    #[error("no such array; the file has {there}")]
    Absent {
        /// Names of the first existing arrays.
        there: String,
    },
    /// Rows beyond the end of the array.
    #[error("rows {} to {} were requested, but the array has {rows} rows, counted from 0", asked.start, asked.end)]
    Rows {
        /// Requested rows, end exclusive.
        asked: Range<u64>,
        /// Number of rows of the array.
        rows: u64,
    },
    /// Pickle that needs a class or function other than plain values and arrays. No code of the pickle was run.
    #[error("byte {at}: needs `{global}`, and code of a pickle is not run; {mend}")]
    Global {
        /// Offset, bytes.
        at: u64,
        /// Module and name of the class or function.
        global: String,
        /// Remedy.
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

    /// Copies the problem for a later request. Kinds that cannot be copied become `Structure` with the same text.
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

    /// Adds the part of the file to which the offsets of the problem refer.
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
