//! A device that is present, and not opened.

use std::fmt;

use crate::id::DriverKey;

/// A device that a driver sees.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Found {
    /// The driver that would open it.
    pub driver: DriverKey,
    /// What it calls itself, with control characters written out.
    pub title: String,
    /// The arguments that choose it among its like: `serial=D20042`.
    pub arguments: String,
    /// Whether it could be opened.
    pub access: Access,
}

/// Whether a device that is seen could be opened.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Access {
    /// It could.
    Ready,
    /// This user may not open it.
    Denied {
        /// What would change that.
        remedy: String,
    },
    /// Somebody else holds it.
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
