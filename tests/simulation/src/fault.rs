//! Wrappers that make a device fail like real hardware. A seed determines the calls that fail.
//!
//! A fault appears as on a real device: a frozen force transducer answers promptly with old values. The [`FaultLog`] counts the faults, so that a test can
//! prove that each kind occurred.

mod draw;
mod force;
mod kind;
mod link;
mod log;
mod plan;
mod robot;
mod sensor;

pub use force::FaultyForce;
pub use kind::FaultKind;
pub use log::FaultLog;
pub use plan::{FaultPlan, Likelihood};
pub use robot::FaultyRobot;
pub use sensor::FaultySensor;
