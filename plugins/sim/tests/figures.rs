//! The bench against the published figures of the four sensors: the paper's protocol, its definitions, its numbers.
//!
//! What was tuned to which number stands in `docs/validation.md`; `cargo test -p taceva-sim --test figures -- --nocapture` prints the
//! table of that file.

#![expect(
    clippy::print_stdout,
    reason = "the figures are to be read, and copied into the table"
)]

#[path = "figures/calibration.rs"]
mod calibration;
#[path = "figures/discriminant.rs"]
mod discriminant;
#[path = "figures/gratings.rs"]
mod gratings;
#[path = "figures/hysteresis.rs"]
mod hysteresis;
#[path = "figures/sensitivity.rs"]
mod sensitivity;
#[path = "figures/spectrum.rs"]
mod spectrum;
#[path = "figures/study.rs"]
mod study;
#[path = "run/trial.rs"]
mod trial;
