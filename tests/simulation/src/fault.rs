//! Devices that go wrong on purpose: a device in a wrapper that, call by call and by a seed, does what failing hardware does.
//!
//! Nothing about a fault is announced but what a real one would show: a frozen force transducer answers promptly, and wrongly.
//! What did go wrong is counted in the [`FaultLog`], so that a test can prove that each kind has happened.

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
