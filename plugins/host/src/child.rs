//! Plugins in a separate process.
//!
//! [`Child::start`] runs this program again as a *host child*. That process confines itself ([`Confinement`]), then loads a plugin and answers calls.
//! The host wraps the child's devices in the device traits of `taceva_core`. A crash or misbehaviour of the plugin reaches the host as a typed error
//! ([`ChildError`]) of that child's devices and affects nothing else.
//!
//! | data | transport |
//! |---|---|
//! | orders: open, describe, discover, end | one socket pair per child |
//! | calls of a device | one socket pair per device, served by its own thread: a call blocks only its device |
//! | interrupt, halt | a second socket pair per device, served by another thread: bypasses the call queue |
//! | log lines | one socket per child, read by its own thread |
//! | printed output | one pipe per child, read by its keeper; lines go to the log by their own thread |
//! | frames | memory of a sealed size, written in place by the child, copied once by the host |
//!
//! The host checks every length and number that a child sends ([`wire`]). Every call has a timeout after which the child is killed
//! ([`Patience`]). A child that breaks a rule is killed at once.

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
mod printed_lines;
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
