//! Errors of interpreters and their environments.

use std::io;
use std::path::PathBuf;

use taceva_core::{ErrorKind, shown};

use crate::wire_version::WIRE;

/// Failure to run a Python plugin or to query its environment.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PythonError {
    /// No interpreter can run the plugin.
    #[error("it is written in Python, and {}", without_interpreter(rejected))]
    NoInterpreter {
        /// The named interpreters, each with the reason why it cannot run the plugin.
        rejected: Vec<String>,
    },
    /// The interpreter is missing or cannot be started.
    #[error(
        "{}: cannot be started: {source}; expected the interpreter of an environment with `taceva`, such as .venv/bin/python",
        shown(program)
    )]
    Start {
        /// Path of the interpreter.
        program: PathBuf,
        /// Error of the system.
        source: io::Error,
    },
    /// Every user may write to the interpreter or to a folder above it.
    #[error(
        "{}: every user of this machine may write to {}, expected write access for its owner only",
        shown(program),
        shown(path)
    )]
    WorldWritable {
        /// Path of the interpreter.
        program: PathBuf,
        /// The writable file or folder.
        path: PathBuf,
    },
    /// The interpreter did not answer the query.
    #[error(
        "{}: cannot list its environment: {problem}; expected Python 3.11 or later",
        shown(program)
    )]
    Silent {
        /// Path of the interpreter.
        program: PathBuf,
        /// Description of the fault.
        problem: String,
    },
    /// The package `taceva` is missing in the environment or too old for plugins.
    #[error(
        "{}: {problem}; install it by `{} -m pip install PATH/TO/dist/taceva-{}-*.whl`: `.ci/wheel dist` builds this wheel in a clone, because taceva is not on PyPI yet", shown(program), shown(program), env!("CARGO_PKG_VERSION")
    )]
    NoPackage {
        /// Path of the interpreter.
        program: PathBuf,
        /// Description of the fault.
        problem: &'static str,
    },
    /// The user that runs the plugin may not read a required file.
    #[error(
        "let every user read {} (`chmod o+rx`): a plugin started by root runs as user {user}, who needs {}, but {} denies it. Otherwise make the environment from an interpreter that every user may read, such as /usr/bin/python3, run the plugin unconfined with `--trust ID`, or run `taceva` as another user than root",
        shown(closed),
        shown(path),
        shown(closed)
    )]
    Closed {
        /// The required file or folder.
        path: PathBuf,
        /// The file or folder that denies access.
        closed: PathBuf,
        /// User id.
        user: u32,
    },
    /// A file of the plugin cannot be read.
    #[error("{}: {source}", shown(path))]
    File {
        /// Path of the file.
        path: PathBuf,
        /// Error of the system.
        source: io::Error,
    },
    /// The package exceeds a size limit.
    #[error(
        "the package {} has more than {most}: move data and environments out of its folder",
        shown(folder)
    )]
    TooMuch {
        /// Folder of the package.
        folder: PathBuf,
        /// The exceeded limit.
        most: &'static str,
    },
}

impl PythonError {
    /// Kind of the failure.
    pub fn kind(&self) -> ErrorKind {
        match self {
            PythonError::NoInterpreter { .. } | PythonError::NoPackage { .. } => {
                ErrorKind::NotFound
            }
            PythonError::WorldWritable { .. } | PythonError::Closed { .. } => {
                ErrorKind::PermissionDenied
            }
            PythonError::Silent { .. } => ErrorKind::Protocol,
            PythonError::TooMuch { .. } => ErrorKind::OutOfRange,
            PythonError::Start { source, .. } | PythonError::File { source, .. } => {
                match source.kind() {
                    io::ErrorKind::NotFound => ErrorKind::NotFound,
                    io::ErrorKind::PermissionDenied => ErrorKind::PermissionDenied,
                    _ => ErrorKind::Internal,
                }
            }
        }
    }
}

/// Reason why no interpreter runs a plugin, in words that follow "and".
fn without_interpreter(rejected: &[String]) -> String {
    match rejected {
        [] => "no interpreter is known: name one by `--python VENV/bin/python`, or for every command by `python = [\"…\"]` below `[plugins]` of ~/.config/taceva/config.toml".to_owned(),
        rejected => format!("no named interpreter can run it: {}", rejected.join("; ")),
    }
}

/// Error message for a plugin that was written for wire version `found`.
pub(crate) fn other_wire(found: u32) -> String {
    format!(
        "written for wire version {found}, but this TacEva has {WIRE}: install the package `taceva` of the version of the program ({}), then run `python -m taceva.plugin manifest MODULE --write`",
        env!("CARGO_PKG_VERSION")
    )
}
