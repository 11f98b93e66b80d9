//! What can be wrong with a file of arrays.

use std::ops::Range;
use std::path::PathBuf;

/// Why a file of arrays, or an array of it, was not read or not written.
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
    /// The array, if one was asked for.
    pub array: Option<String>,
    /// What is wrong.
    #[source]
    pub problem: Problem,
}

/// What is wrong with a file, where, and what would mend it. Offsets are in bytes from the beginning of the file, or of the member or
/// chunk that the text names.
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
    /// The operating system refused.
    #[error("cannot {doing}: {source}")]
    Io {
        /// What was being done.
        doing: &'static str,
        /// What the system said.
        source: std::io::Error,
    },
    /// Bytes that contradict the format.
    #[error("byte {at}: {found}, expected {expected}")]
    Damaged {
        /// Where, in bytes.
        at: u64,
        /// What stands there.
        found: String,
        /// What should.
        expected: String,
    },
    /// Something that the format allows and this crate does not read, or that it does not write.
    #[error("{found}; {mend}")]
    Unsupported {
        /// What was found.
        found: String,
        /// What to do instead.
        mend: String,
    },
    /// A size beyond what is accepted; nothing was allocated for it.
    #[error("{what}: {size}, above the limit of {limit}")]
    TooLarge {
        /// What is large, with its unit.
        what: String,
        /// Its size.
        size: u64,
        /// The largest that is accepted.
        limit: u64,
    },
    /// A checksum of the file that does not agree with its content.
    #[error(
        "{what}: checksum {computed:#010x}, the file states {stated:#010x}: it was damaged after it was written"
    )]
    Checksum {
        /// What was summed.
        what: String,
        /// What the file says.
        stated: u32,
        /// What its bytes give.
        computed: u32,
    },
    /// A structure of the file that does not hold together, in the words of the library that reads it.
    #[error("{problem}")]
    Structure {
        /// What the library says.
        problem: String,
    },
    /// No array of that name.
    #[error("no such array; there are {there}")]
    Absent {
        /// The first names that are there.
        there: String,
    },
    /// Rows that the array does not have.
    #[error("no rows {} to {}, there are {rows} from 0", asked.start, asked.end)]
    Rows {
        /// Those that were asked for, the last not among them.
        asked: Range<u64>,
        /// How many there are.
        rows: u64,
    },
    /// A pickle that asks for a class or function beyond plain values and arrays. Nothing of it was run.
    #[error("byte {at}: wants `{global}`, which is not run here; {mend}")]
    Global {
        /// Where, in bytes.
        at: u64,
        /// Module and name.
        global: String,
        /// What to do instead.
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

    /// The same once more, for whoever asks again for an array that is refused.
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

    /// The same with the part of the file that offsets are within.
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
