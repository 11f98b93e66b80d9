//! Plugins in a process of their own.
//!
//! [`Child::start`] runs this program again as a *host child*: a process that confines itself ([`Confinement`]), loads what it serves only
//! then, and answers calls. What it opens comes out as the device traits of core. Whatever a plugin does to its process, the host learns
//! as a typed error of the devices of that child ([`ChildError`]), and nothing else is affected.
//!
//! | what goes | how |
//! |---|---|
//! | orders: open, describe, discover, end | one pair of sockets a child |
//! | calls of a device | one pair a device, served by a thread of its own: a call blocks its device alone |
//! | interrupt, halt | a second pair a device, served by another thread: round the queue |
//! | lines of the log | a socket a child, read by a thread of its own |
//! | frames | memory of a sealed size, written in place by the child, copied once by the host |
//!
//! Every length and number that a child sends is checked ([`wire`]), every call has a time after which the child is
//! ended ([`Patience`]), and a child that breaks a rule is ended at once.

mod arguments;
mod array;
mod bench;
mod error;
mod exit_status;
mod flood;
mod keeper;
mod kind;
mod life;
mod link;
mod log;
mod main_hook;
mod memory;
mod model;
mod plain;
mod plugin;
mod quarantine;
mod reply;
mod sandbox;
mod serve;
mod session;
mod socket;
mod spec;
mod start;
mod thread;
mod timeouts;
mod usage;
mod watch;
pub(crate) mod wire;

pub use error::ChildError;
pub use exit_status::Fate;
pub use log::CALL;
pub use main_hook::{CHILD_ARGUMENT, main_if_child_with};
pub use plugin::{
    Examiner, ModuleToImport, main_if_child, main_if_child_examining, serve_as_child,
};
pub use quarantine::{Quarantine, Quarantined};
pub use sandbox::{Confinement, Isolation};
pub(crate) use sandbox::{NOBODY, no_port};
pub use session::ChildSession;
pub use spec::ChildSpec;
pub use start::Child;
pub use timeouts::Patience;
pub use wire::read_any_message;
