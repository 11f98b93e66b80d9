//! Why a library was not loaded.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};
use taceva_core::shown;

use taceva_core::{DriverError, DriverKey, ErrorKind};

use crate::call::Failure;
use crate::manifest::{ManifestError, Sha256Digest};

/// A library that was not loaded: which file, and why.
#[derive(Debug)]
pub struct LoadError {
    path: PathBuf,
    problem: LoadProblem,
}

impl LoadError {
    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// What is wrong with it.
    pub fn problem(&self) -> &LoadProblem {
        &self.problem
    }

    /// What is wrong, alone.
    pub fn into_problem(self) -> LoadProblem {
        self.problem
    }

    /// The same, as the failure of a driver of the plugin.
    pub fn of_driver(self, driver: &DriverKey) -> DriverError {
        DriverError::new(self.problem.kind(), driver, "load the plugin").because(self)
    }
}

impl fmt::Display for LoadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", shown(&self.path), self.problem)
    }
}

impl std::error::Error for LoadError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match &self.problem {
            LoadProblem::File(source) => Some(source),
            LoadProblem::Describes { source, .. } => Some(source),
            _ => None,
        }
    }
}

/// What is wrong with a library.
#[derive(Debug)]
#[non_exhaustive]
pub enum LoadProblem {
    /// It cannot be read.
    File(io::Error),
    /// A folder, a pipe or a device.
    NotAFile,
    /// Longer than any library.
    TooLong {
        /// The most that is read.
        most: u64,
    },
    /// Not the bytes that the manifest promises.
    Digest {
        /// As the manifest says.
        expected: Sha256Digest,
        /// Of the file.
        found: Sha256Digest,
    },
    /// Not a shared library.
    NotALibrary,
    /// A shared library of another machine.
    OtherMachine,
    /// A shared library whose end is missing.
    CutOff,
    /// The system's loader refused it.
    Loader(String),
    /// The system's loader did not find what it needs, which it looks for beside itself.
    BesideItself {
        /// What the loader says.
        message: String,
        /// Where it looks.
        run_path: String,
    },
    /// It exports no `taceva_plugin_v1`.
    Symbol(String),
    /// The exported symbol, or a text in it, lies where nothing can be read.
    Address {
        /// What lies there.
        what: &'static str,
    },
    /// The exported symbol is something else.
    Magic {
        /// What stands where the magic number should.
        found: u32,
    },
    /// Written for another major version of the interface.
    Major {
        /// Its version.
        found: u32,
    },
    /// The exported symbol ends before what every plugin has.
    Size {
        /// Its size.
        found: usize,
        /// The least.
        least: usize,
    },
    /// A text of the library is not UTF-8.
    Text {
        /// Which text.
        what: &'static str,
    },
    /// The library says something else than its manifest.
    Differs {
        /// What they disagree about.
        what: String,
        /// As the manifest says.
        manifest: String,
        /// As the library says.
        library: String,
    },
    /// A function that every plugin has is NULL.
    Lacks {
        /// Its name.
        what: &'static str,
    },
    /// Its `init` failed.
    Init(Failure),
    /// A table of functions that cannot be one.
    Table(String),
    /// A driver could not be described.
    Describe(Failure),
    /// What it says of a driver does not read.
    Describes {
        /// Which one.
        driver: String,
        /// What is wrong with the text.
        source: ManifestError,
    },
}

impl LoadProblem {
    pub(super) fn of(self, path: &Path) -> LoadError {
        LoadError {
            path: path.to_owned(),
            problem: self,
        }
    }

    /// What kind of failure it is.
    pub fn kind(&self) -> ErrorKind {
        match self {
            LoadProblem::File(error) => match error.kind() {
                io::ErrorKind::NotFound => ErrorKind::NotFound,
                io::ErrorKind::PermissionDenied => ErrorKind::PermissionDenied,
                _ => ErrorKind::Protocol,
            },
            LoadProblem::Init(failure) | LoadProblem::Describe(failure) => failure.kind(),
            LoadProblem::Digest { .. } => ErrorKind::PermissionDenied,
            LoadProblem::NotAFile
            | LoadProblem::TooLong { .. }
            | LoadProblem::NotALibrary
            | LoadProblem::OtherMachine
            | LoadProblem::CutOff
            | LoadProblem::Loader(_)
            | LoadProblem::BesideItself { .. } => ErrorKind::Protocol,
            _ => ErrorKind::Abi,
        }
    }
}

impl fmt::Display for LoadProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            LoadProblem::File(error) => write!(f, "{error}"),
            LoadProblem::NotAFile => f.write_str("no regular file"),
            LoadProblem::TooLong { most } => write!(f, "longer than {most} bytes"),
            LoadProblem::Digest { expected, found } => write!(
                f,
                "sha256 is {found}, the manifest says {expected}: another build, or another's"
            ),
            LoadProblem::NotALibrary => f.write_str("no shared library"),
            LoadProblem::OtherMachine => f.write_str("a shared library for another machine"),
            LoadProblem::CutOff => f.write_str("a shared library that is cut off"),
            LoadProblem::Loader(message) => write!(f, "the loader refused it: {message}"),
            LoadProblem::BesideItself { message, run_path } => write!(
                f,
                "the loader refused it: {message}; it looks in `{run_path}`, and a library that is loaded from a sealed copy has no folder of its own: link what it needs into it, or install that among the system's libraries"
            ),
            LoadProblem::Symbol(message) => {
                write!(f, "it exports no `taceva_plugin_v1`: {message}")
            }
            LoadProblem::Address { what } => {
                write!(f, "{what} lies where nothing can be read, or misaligned")
            }
            LoadProblem::Magic { found } => write!(
                f,
                "`taceva_plugin_v1` begins with {found:#010x}, expected {:#010x}",
                taceva_abi::MAGIC
            ),
            LoadProblem::Major { found } => write!(
                f,
                "written for version {found} of the interface, this TacEva has {}",
                taceva_abi::ABI_MAJOR
            ),
            LoadProblem::Size { found, least } => write!(
                f,
                "`taceva_plugin_v1` has {found} bytes, expected at least {least}"
            ),
            LoadProblem::Text { what } => write!(f, "{what} is not UTF-8"),
            LoadProblem::Differs {
                what,
                manifest,
                library,
            } => write!(
                f,
                "{what}: the manifest says {manifest}, the library {library}"
            ),
            LoadProblem::Lacks { what } => write!(f, "its `{what}` is NULL"),
            LoadProblem::Init(failure) => write!(f, "its `init` failed: {failure}"),
            LoadProblem::Table(problem) => f.write_str(problem),
            LoadProblem::Describe(failure) => write!(f, "its `describe` failed: {failure}"),
            LoadProblem::Describes { driver, source } => {
                write!(f, "what it says of {driver}, {source}")
            }
        }
    }
}
