//! Result of a search for connected devices, which opens no device.

use std::fmt;

use crate::id::DriverKey;

/// A device that a driver found.
///
/// ```
/// use taceva_core::{Access, DriverKey, Found};
/// let found = Found::new(DriverKey::fixed("digit/usb"), "DIGIT D20042").with_arguments("serial=D20042");
/// assert_eq!((found.arguments.as_str(), found.access), ("serial=D20042", Access::Ready));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Found {
    /// Driver that can open the device.
    pub driver: DriverKey,
    /// Name that the device reports, with control characters escaped.
    pub title: String,
    /// Arguments with which the driver opens this device and no other: `serial=D20042`.
    pub arguments: String,
    /// State of access to the device: ready, denied or busy.
    pub access: Access,
}

impl Found {
    /// A device that `driver` can open now, without arguments that tell it from other devices.
    pub fn new(driver: DriverKey, title: impl Into<String>) -> Found {
        Found {
            driver,
            title: title.into(),
            arguments: String::new(),
            access: Access::Ready,
        }
    }

    /// The same device with the arguments that select it.
    #[must_use]
    pub fn with_arguments(self, arguments: impl Into<String>) -> Found {
        Found {
            arguments: arguments.into(),
            ..self
        }
    }

    /// The same device with `access`.
    #[must_use]
    pub fn with_access(self, access: Access) -> Found {
        Found { access, ..self }
    }
}

/// Access to a device that a driver found.
///
/// ```
/// use taceva_core::Access;
/// let denied = Access::Denied { remedy: "add yourself to the group `video`".to_owned() };
/// assert_eq!(denied.to_string(), "seen, but not permitted: add yourself to the group `video`");
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Access {
    /// The device can be opened.
    Ready,
    /// This user may not open the device.
    Denied {
        /// Action that would grant access.
        remedy: String,
    },
    /// Another program has the device open.
    Busy,
}

impl fmt::Display for Access {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Access::Ready => f.write_str("ready"),
            Access::Denied { remedy } => write!(f, "seen, but not permitted: {remedy}"),
            Access::Busy => f.write_str("in use by another program"),
        }
    }
}
