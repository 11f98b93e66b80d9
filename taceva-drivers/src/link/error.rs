//! Failures of links to devices.

use std::io;
use std::net::SocketAddr;

use taceva_core::ErrorKind;

use super::mailbox::Ending;
use crate::text::shown;

/// Failure of a link.
#[derive(Debug, thiserror::Error)]
pub(crate) enum LinkError {
    /// The host name cannot be resolved.
    #[error("`{}` has no address: {source}; expected a host name or an address such as `192.168.1.10`", shown(.host))]
    Resolve { host: String, source: io::Error },
    /// The connection was refused or timed out.
    #[error("{address} does not accept a connection: {source}")]
    Connect {
        address: SocketAddr,
        source: io::Error,
    },
    /// The connection broke.
    #[error("the connection to {address} broke: {source}")]
    Broken {
        address: SocketAddr,
        source: io::Error,
    },
    /// The other side closed the connection. Does not occur with datagrams.
    #[cfg(any(feature = "mjpeg", feature = "sri", feature = "ur", feature = "xarm"))]
    #[error("{address} closed the connection")]
    Closed { address: SocketAddr },
}

impl LinkError {
    /// Kind of the failure.
    pub(crate) fn kind(&self) -> ErrorKind {
        match self {
            LinkError::Resolve { .. } => ErrorKind::NotFound,
            LinkError::Connect { source, .. } => match source.kind() {
                io::ErrorKind::PermissionDenied => ErrorKind::PermissionDenied,
                io::ErrorKind::TimedOut | io::ErrorKind::WouldBlock => ErrorKind::Timeout,
                _ => ErrorKind::NotFound,
            },
            LinkError::Broken { .. } => ErrorKind::Disconnected,
            #[cfg(any(feature = "mjpeg", feature = "sri", feature = "ur", feature = "xarm"))]
            LinkError::Closed { .. } => ErrorKind::Disconnected,
        }
    }
}

impl From<LinkError> for Ending {
    fn from(error: LinkError) -> Ending {
        Ending {
            kind: error.kind(),
            why: error.to_string(),
        }
    }
}
