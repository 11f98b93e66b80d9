//! What is wrong with an interpreter or with its environment.

use std::io;
use std::path::PathBuf;

use taceva_core::{ErrorKind, shown};

use crate::wire_version::WIRE;

/// Why a plugin in Python cannot be run, or its environment not be asked.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PythonError {
    /// No interpreter is known.
    #[error(
        "it is written in Python, and no interpreter is known: `--python VENV/bin/python` names one for this command, `python = [\"…\"]` below `[plugins]` of ~/.config/taceva/config.toml for every command"
    )]
    NoInterpreter,
    /// The interpreter is not there, or cannot be started.
    #[error(
        "{}: cannot be started: {source}; expected the interpreter of an environment, such as .venv/bin/python, in which `taceva` is installed",
        shown(program)
    )]
    Start {
        /// The interpreter.
        program: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// Every user of the machine may write to it.
    #[error(
        "{}: every user of this machine may write to {}, expected one that only its owner may",
        shown(program),
        shown(path)
    )]
    WorldWritable {
        /// The interpreter.
        program: PathBuf,
        /// The file or folder that they may write.
        path: PathBuf,
    },
    /// It did not say what it was asked.
    #[error(
        "{}: it did not say what lies in its environment: {problem}; expected Python 3.11 or later",
        shown(program)
    )]
    Silent {
        /// The interpreter.
        program: PathBuf,
        /// What it did instead.
        problem: String,
    },
    /// The package `taceva` is missing in the environment, or too old for plugins.
    #[error(
        "{}: {problem}; `{} -m pip install taceva=={}` installs it", shown(program), shown(program), env!("CARGO_PKG_VERSION")
    )]
    NoPackage {
        /// The interpreter.
        program: PathBuf,
        /// What is missing.
        problem: &'static str,
    },
    /// The user that plugins run as may not read it.
    #[error(
        "a plugin of root runs as user {user}, who may not read {}: it is closed by {}; let every user read it (`chmod o+rx`), make the environment from an interpreter that lies elsewhere, such as /usr/bin/python3, or run `taceva` as another user than root",
        shown(path),
        shown(closed)
    )]
    Closed {
        /// What is to be read.
        path: PathBuf,
        /// The file or folder that closes it.
        closed: PathBuf,
        /// The user.
        user: u32,
    },
    /// A file of the plugin cannot be read.
    #[error("{}: {source}", shown(path))]
    File {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// There is more in the package than any plugin has.
    #[error("{}: more than {most}", shown(folder))]
    TooMuch {
        /// The folder of the package.
        folder: PathBuf,
        /// The limit.
        most: &'static str,
    },
}

impl PythonError {
    /// What kind of failure it is.
    pub fn kind(&self) -> ErrorKind {
        match self {
            PythonError::NoInterpreter | PythonError::NoPackage { .. } => ErrorKind::NotFound,
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

/// What is said of a plugin that was written for another version of the wire.
pub(crate) fn other_wire(found: u32) -> String {
    format!(
        "written for version {found} of the wire, this TacEva speaks {WIRE}: `python -m taceva.plugin manifest MODULE --write` writes the version of the package `taceva` that is installed, which must be that of the program ({})",
        env!("CARGO_PKG_VERSION")
    )
}
