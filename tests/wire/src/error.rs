//! Why there is no bench.

use std::io;
use std::path::PathBuf;

use taceva_sim::ParameterError;
use taceva_sim::optics::OpticsError;
use thiserror::Error;

/// A bench that cannot be started, or a request that it does not take.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum WireError {
    /// A port that cannot be listened on.
    #[error("cannot listen on {address}: {source}")]
    Listen {
        /// The address.
        address: String,
        /// Why.
        source: io::Error,
    },
    /// A thread that does not start.
    #[error("cannot start a thread: {0}")]
    Thread(io::Error),
    /// Parameters that make no gel.
    #[error("the parameters of the gel, {0}")]
    Parameters(#[from] ParameterError),
    /// A camera that cannot be made.
    #[error("the camera: {0}")]
    Optics(#[from] OpticsError),
    /// A request on the control port that is none.
    #[error("{0}")]
    Request(String),
    /// A file that cannot be written.
    #[error("cannot write {path}: {source}")]
    Write {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
}
