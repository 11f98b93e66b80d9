//! Machines that take G-code over a serial line: mills and printers that carry an indenter.

mod grbl;

pub use grbl::GrblFactory;
