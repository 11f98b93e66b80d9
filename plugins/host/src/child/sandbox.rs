//! Sandbox of a child. The host requests the limits. The child applies them before it loads code, and reports the result.

mod confinement;
mod devices;
mod enforce;
mod files;
mod identity;
mod isolation;
mod seccomp;

pub use confinement::Confinement;
pub use isolation::Isolation;

use crate::manifest::Need;

pub(crate) use devices::no_port;
pub(crate) use enforce::{confine, seal};
pub(crate) use identity::NOBODY;
