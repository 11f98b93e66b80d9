//! G-code machines on a serial port: mills and printers that move an indenter.

#[cfg(feature = "grbl")]
pub mod grbl;
mod limits;
mod link;
#[cfg(feature = "marlin")]
pub mod marlin;
mod port;
mod present;
mod stop;
