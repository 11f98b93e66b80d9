//! Errors of opening a page.

use std::io;

/// Errors of opening a page.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PageError {
    /// A port that cannot be listened on.
    #[error(
        "cannot listen on 127.0.0.1:{port}: {source}; expected a free port, or 0 for any: --port 0"
    )]
    Listen {
        /// The port.
        port: u16,
        /// The error of the system.
        source: io::Error,
    },
    /// The system provides no random numbers for the token.
    #[error("cannot get random numbers for the token of the page: {0}")]
    Random(String),
    /// A thread of the page that cannot be started.
    #[error("cannot start a thread of the page: {0}")]
    Thread(io::Error),
}
