//! The bench compared with the published figures of the four sensors, with the paper's protocol and definitions.
//!
//! `docs/validation.md` states which numbers were used for tuning. `cargo test -p taceva-sim --test sim figures -- --nocapture` prints the table of
//! that file.

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
