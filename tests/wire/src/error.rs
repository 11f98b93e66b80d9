//! Errors of the emulated devices and their simulated gel.

use std::io;
use std::path::PathBuf;

use taceva_sim::ParameterError;
use taceva_sim::optics::OpticsError;
use thiserror::Error;

/// Error of starting a bench, or of a request.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum WireError {
    /// The server cannot listen on a port.
    #[error("cannot listen on {address}: {source}")]
    Listen {
        /// Address of the port.
        address: String,
        /// Error of the system.
        source: io::Error,
    },
    /// A thread does not start.
    #[error("cannot start a thread: {0}")]
    Thread(io::Error),
    /// The parameters describe no valid gel.
    #[error("the parameters of the gel, {0}")]
    Parameters(#[from] ParameterError),
    /// The camera cannot be created.
    #[error("the camera: {0}")]
    Optics(#[from] OpticsError),
    /// Invalid request on the control port.
    #[error("{0}")]
    Request(String),
    /// A file cannot be written.
    #[error("cannot write {path}: {source}")]
    Write {
        /// Path of the file.
        path: PathBuf,
        /// Error of the system.
        source: io::Error,
    },
}
