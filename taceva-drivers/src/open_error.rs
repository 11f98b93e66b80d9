//! Why a device or a switch was not opened.

use taceva_core::{ArgError, DriverError, ErrorKind, RegistryError};

/// Why a device was not opened.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum OpenError {
    /// No driver of that name.
    #[error(transparent)]
    Unknown(#[from] RegistryError),
    /// An argument that the driver does not take.
    #[error("{selector}: {source}")]
    Arguments {
        /// What was asked for.
        selector: String,
        /// What is wrong with it.
        source: ArgError,
    },
    /// A device that did not open.
    #[error(transparent)]
    Device(#[from] DriverError),
}

impl OpenError {
    /// What kind of failure it was.
    pub fn kind(&self) -> ErrorKind {
        match self {
            OpenError::Unknown(_) => ErrorKind::NotFound,
            OpenError::Arguments { .. } => ErrorKind::InvalidArgument,
            OpenError::Device(error) => error.kind(),
        }
    }
}
