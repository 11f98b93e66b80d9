//! Why a page cannot be opened.

use std::io;

/// Why a page cannot be opened.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PageError {
    /// The port cannot be listened on.
    #[error(
        "cannot listen on 127.0.0.1:{port}: {source}; expected a free port, or 0 for any: --port 0"
    )]
    Listen {
        /// The port.
        port: u16,
        /// Why.
        source: io::Error,
    },
    /// The system gives no random numbers for the token.
    #[error("this system gives no random numbers for the token of the page: {0}")]
    Random(String),
    /// A thread of the page cannot be started.
    #[error("cannot start a thread of the page: {0}")]
    Thread(io::Error),
}
