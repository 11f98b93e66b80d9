//! Why there is no page.

use std::io;

/// Why there is no page.
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
    /// No random numbers for the token.
    #[error("this system gives no random numbers for the token of the page: {0}")]
    Random(String),
    /// No thread starts.
    #[error("cannot start a thread of the page: {0}")]
    Thread(io::Error),
}
