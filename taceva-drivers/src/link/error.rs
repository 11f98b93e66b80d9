//! Why a link to a device could not be made, or is of no use any more.

use std::io;
use std::net::SocketAddr;

use taceva_core::ErrorKind;

use super::mailbox::Ending;
use crate::text::shown;

/// A link that failed.
#[derive(Debug, thiserror::Error)]
pub(crate) enum LinkError {
    /// A name that leads nowhere.
    #[error("`{}` has no address: {source}; expected a name or a number such as `192.168.1.10`", shown(.host))]
    Resolve { host: String, source: io::Error },
    /// Nobody listens, or nobody answers.
    #[error("{address} does not accept a connection: {source}")]
    Connect {
        address: SocketAddr,
        source: io::Error,
    },
    /// It broke.
    #[error("the connection to {address} broke: {source}")]
    Broken {
        address: SocketAddr,
        source: io::Error,
    },
    /// The other side closed it, which datagrams do not tell.
    #[cfg(any(feature = "mjpeg", feature = "sri", feature = "ur", feature = "xarm"))]
    #[error("{address} closed the connection")]
    Closed { address: SocketAddr },
}

impl LinkError {
    /// What kind of failure it is.
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
