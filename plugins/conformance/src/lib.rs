#![doc = include_str!("../README.md")]

mod changer;
mod force;
mod lighting;
#[cfg(target_os = "linux")]
mod plugin;
mod promise;
mod report;
mod robot;
mod sensor;
mod stream;
mod trial;

pub use changer::changer;
pub use force::force;
pub use lighting::lighting;
#[cfg(target_os = "linux")]
pub use plugin::{Check, CheckRequest, CheckResult, check, checks, main_if_child, serve_as_child};
pub use report::{Outcome, Report, Tested};
pub use robot::robot;
pub use sensor::sensor;
pub use trial::Trial;
