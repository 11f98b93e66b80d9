//! Errors of loading a library.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};
use taceva_core::shown;

use taceva_core::{DriverError, DriverKey, ErrorKind};

use crate::call::Failure;
use crate::manifest::{ManifestError, Sha256Digest};

/// Failure to load a library, with its path.
#[derive(Debug)]
pub struct LoadError {
    path: PathBuf,
    problem: LoadProblem,
}

impl LoadError {
    /// Path of the library.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Cause of the failure.
    pub fn problem(&self) -> &LoadProblem {
        &self.problem
    }

    /// Cause of the failure, without the path.
    pub fn into_problem(self) -> LoadProblem {
        self.problem
    }

    /// Converts the failure into an error of a driver of the plugin.
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

/// Cause of a failure to load a library.
#[derive(Debug)]
#[non_exhaustive]
pub enum LoadProblem {
    /// The file cannot be read.
    File(io::Error),
    /// The path is a folder, a pipe or a device.
    NotAFile,
    /// The file is longer than the limit.
    TooLong {
        /// Maximum length, bytes.
        most: u64,
    },
    /// The digest differs from the digest in the manifest.
    Digest {
        /// Digest in the manifest.
        expected: Sha256Digest,
        /// Digest of the file.
        found: Sha256Digest,
    },
    /// The file is not a shared library.
    NotALibrary,
    /// The file is a shared library for another machine.
    OtherMachine,
    /// The file is a shared library that is truncated.
    CutOff,
    /// The system's loader rejected the library.
    Loader(String),
    /// The system's loader did not find a dependency in the library's own folder (`$ORIGIN`).
    BesideItself {
        /// Message of the loader.
        message: String,
        /// Run path of the library.
        run_path: String,
    },
    /// The library does not export `taceva_plugin_v1`.
    Symbol(String),
    /// The exported symbol, or a text in it, is at an unreadable or misaligned address.
    Address {
        /// Name of the item at that address.
        what: &'static str,
    },
    /// The exported symbol has the wrong magic number.
    Magic {
        /// Number found.
        found: u32,
    },
    /// The library uses another major version of the interface.
    Major {
        /// Major version of the library.
        found: u32,
    },
    /// The exported symbol is too short.
    Size {
        /// Size of the symbol, bytes.
        found: usize,
        /// Minimum size, bytes.
        least: usize,
    },
    /// A text of the library is not UTF-8.
    Text {
        /// Name of the text.
        what: &'static str,
    },
    /// The library contradicts its manifest.
    Differs {
        /// Name of the differing item.
        what: String,
        /// Value in the manifest.
        manifest: String,
        /// Value in the library.
        library: String,
        /// Name of the Python module; `None` for a library.
        module: Option<String>,
    },
    /// A required function is NULL.
    Lacks {
        /// Name of the function.
        what: &'static str,
    },
    /// The plugin's `init` failed.
    Init(Failure),
    /// A function table is invalid.
    Table(String),
    /// The library failed to describe a driver.
    Describe(Failure),
    /// The description of a driver cannot be parsed.
    Describes {
        /// Name of the driver.
        driver: String,
        /// Error in the text.
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

    /// Kind of the failure.
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
            LoadProblem::NotAFile => f.write_str("not a regular file"),
            LoadProblem::TooLong { most } => write!(f, "longer than {most} bytes"),
            LoadProblem::Digest { expected, found } => write!(
                f,
                "sha256 is {found}, expected {expected} from the manifest: a different or modified build"
            ),
            LoadProblem::NotALibrary => f.write_str("not a shared library"),
            LoadProblem::OtherMachine => f.write_str("a shared library for another machine"),
            LoadProblem::CutOff => f.write_str("a truncated shared library"),
            LoadProblem::Loader(message) => write!(f, "the system's loader rejected it: {message}"),
            LoadProblem::BesideItself { message, run_path } => write!(
                f,
                "the system's loader rejected it: {message}; its run path is `{run_path}`, but it is loaded from a sealed copy outside its folder: link its dependencies statically, or install them as system libraries"
            ),
            LoadProblem::Symbol(message) => {
                write!(f, "it exports no `taceva_plugin_v1`: {message}")
            }
            LoadProblem::Address { what } => {
                write!(f, "the address of {what} is unreadable or misaligned")
            }
            LoadProblem::Magic { found } => write!(
                f,
                "`taceva_plugin_v1` begins with {found:#010x}, expected {:#010x}",
                taceva_abi::MAGIC
            ),
            LoadProblem::Major { found } => write!(
                f,
                "written for version {found} of the interface, but this TacEva has {}",
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
                module: None,
            } => write!(
                f,
                "{what}: the manifest says {manifest}, the library {library}; if the library is right, run `taceva plugin manifest --write` in its folder"
            ),
            LoadProblem::Differs {
                what,
                manifest,
                library,
                module: Some(module),
            } => write!(
                f,
                "{what}: the manifest says {manifest}, the module {library}; run `python -m taceva.plugin manifest {module} --write`"
            ),
            LoadProblem::Lacks { what } => write!(f, "its `{what}` is NULL"),
            LoadProblem::Init(failure) => write!(f, "its `init` failed: {failure}"),
            LoadProblem::Table(problem) => f.write_str(problem),
            LoadProblem::Describe(failure) => write!(f, "its `describe` failed: {failure}"),
            LoadProblem::Describes { driver, source } => {
                write!(f, "its description of {driver} is invalid, {source}")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_module_that_differs_from_its_manifest_is_named_with_the_command_that_mends_it() {
        let differs = |module: Option<&str>| LoadProblem::Differs {
            what: "`median`, arguments".to_owned(),
            manifest: "`strength`".to_owned(),
            library: "`quantile`".to_owned(),
            module: module.map(str::to_owned),
        };
        assert_eq!(
            differs(Some("my_median")).to_string(),
            "`median`, arguments: the manifest says `strength`, the module `quantile`; run `python -m taceva.plugin manifest my_median --write`"
        );
        assert_eq!(
            differs(None).to_string(),
            "`median`, arguments: the manifest says `strength`, the library `quantile`; if the library is right, run `taceva plugin manifest --write` in its folder"
        );
    }
}
