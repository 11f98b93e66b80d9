//! Failure to open a device or a switch.

use taceva_core::{ArgError, DriverError, ErrorKind, RegistryError};

/// Failure to open a device.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum OpenError {
    /// The driver is unknown.
    #[error(transparent)]
    Unknown(#[from] RegistryError),
    /// An argument is invalid.
    #[error("{selector}: {source}")]
    Arguments {
        /// Text of the selector.
        selector: String,
        /// Error in an argument.
        source: ArgError,
    },
    /// The device did not open.
    #[error(transparent)]
    Device(#[from] DriverError),
}

impl OpenError {
    /// Kind of the failure.
    pub fn kind(&self) -> ErrorKind {
        match self {
            OpenError::Unknown(_) => ErrorKind::NotFound,
            OpenError::Arguments { .. } => ErrorKind::InvalidArgument,
            OpenError::Device(error) => error.kind(),
        }
    }
}
