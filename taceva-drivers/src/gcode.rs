//! Machines that take G-code over a serial line: mills and printers that carry an indenter.

#[cfg(feature = "grbl")]
pub mod grbl;
mod limits;
mod link;
#[cfg(feature = "marlin")]
pub mod marlin;
mod port;
mod present;
mod stop;
