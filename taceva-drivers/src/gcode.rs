//! Machines that take G-code over a serial line: mills and printers that carry an indenter.

#[cfg(feature = "grbl")]
mod grbl;
mod limits;
mod link;
#[cfg(feature = "marlin")]
mod marlin;
mod port;
mod present;
mod stop;

#[cfg(feature = "grbl")]
pub use grbl::GrblFactory;
#[cfg(feature = "marlin")]
pub use marlin::MarlinFactory;
