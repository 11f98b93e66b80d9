#![doc = include_str!("../README.md")]

#[cfg(target_os = "linux")]
mod check;
mod conformance;

#[cfg(target_os = "linux")]
pub use check::{
    Check as PluginPromise, CheckOutcome, CheckRequest, CheckResult, check, checks, main_if_child,
    serve_as_child,
};
pub use conformance::{Check, Outcome, Report, Trial, changer, force, lighting, robot, sensor};
