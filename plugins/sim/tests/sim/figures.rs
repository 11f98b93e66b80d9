//! The bench against the published figures of the four sensors: the paper's protocol, its definitions, its numbers.
//!
//! What was tuned to which number stands in `docs/validation.md`; `cargo test -p taceva-sim --test sim figures -- --nocapture` prints the
//! table of that file.

#![expect(
    clippy::print_stdout,
    reason = "the figures are to be read, and copied into the table"
)]

mod calibration;
mod discriminant;
mod gratings;
mod hysteresis;
mod sensitivity;
mod spectrum;
mod study;
