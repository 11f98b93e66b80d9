//! Error of opening the page of a run.

use std::io;

/// Reason why a page cannot be opened.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PageError {
    /// The server cannot listen on the port.
    #[error(
        "cannot listen on 127.0.0.1:{port}: {source}; expected a free port, or 0 for any: --port 0"
    )]
    Listen {
        /// Number of the port.
        port: u16,
        /// Error of the operating system.
        source: io::Error,
    },
    /// The operating system provides no random numbers for the token.
    #[error("cannot get random numbers for the token of the page: {0}")]
    Random(String),
    /// The operating system cannot start a thread of the page.
    #[error("cannot start a thread of the page: {0}")]
    Thread(io::Error),
}
