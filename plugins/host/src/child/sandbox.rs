//! Sandbox of a child: ordered by the host, enforced by the child on itself before it loads anything, and reported back.

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
