//! Properties of the pictures of the simulated sensors.

#![expect(
    clippy::print_stdout,
    reason = "mean grays are to be read, and copied into a table"
)]

mod camera;
mod gels;
mod support;
mod worn;
