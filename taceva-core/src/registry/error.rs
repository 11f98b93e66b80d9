//! Errors of adding and finding drivers.

use crate::printable::shown;
use std::fmt;

use super::DescriptorError;
use crate::driver::DriverKind;
use crate::id::DriverKey;

/// Error for a driver that a registry rejects or does not have.
///
/// ```
/// use taceva_core::{Registry, RegistryError, Robot};
/// let robots = Registry::<dyn Robot>::empty();
/// let error = robots.get("sim/arm").map(|_| ()).unwrap_err();
/// assert!(matches!(&error, RegistryError::Unknown { key, .. } if key == "sim/arm"));
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum RegistryError {
    /// The registry has no driver with this name.
    Unknown {
        /// Kind of driver that was requested.
        kind: DriverKind,
        /// Name that the caller requested.
        key: String,
        /// Most similar known name, if any.
        nearest: Option<String>,
        /// Every known name.
        known: Vec<DriverKey>,
    },
    /// The registry already has a driver with this name.
    Twice {
        /// Name of both drivers.
        key: DriverKey,
        /// Title of the driver that was registered.
        first: String,
        /// Title of the driver that was rejected.
        second: String,
    },
    /// The driver's kind differs from the kind of the registry.
    Kind {
        /// Name of the driver.
        key: DriverKey,
        /// Kind of the registry.
        expected: DriverKind,
        /// Kind of the driver.
        found: DriverKind,
    },
    /// The description of a built-in driver contradicts itself.
    Descriptor(DescriptorError),
}

impl fmt::Display for RegistryError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            RegistryError::Unknown {
                kind,
                key,
                nearest,
                known,
            } => {
                write!(f, "`{}`: unknown {kind} driver, ", shown(key))?;
                match (nearest, known.as_slice()) {
                    (Some(nearest), _) => write!(f, "did you mean `{nearest}`?"),
                    (None, []) => write!(f, "and no {kind} driver is known"),
                    (None, known) => {
                        let known: Vec<&str> = known.iter().map(DriverKey::as_str).collect();
                        write!(f, "expected one of `{}`", known.join("`, `"))
                    }
                }
            }
            RegistryError::Twice { key, first, second } => {
                write!(f, "two drivers have the key `{key}`: {first} and {second}")
            }
            RegistryError::Kind {
                key,
                expected,
                found,
            } => write!(
                f,
                "`{key}` is a {found} driver, expected a {expected} driver"
            ),
            RegistryError::Descriptor(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for RegistryError {}

impl From<DescriptorError> for RegistryError {
    fn from(error: DescriptorError) -> RegistryError {
        RegistryError::Descriptor(error)
    }
}
