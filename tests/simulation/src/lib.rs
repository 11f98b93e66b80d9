//! Rigs and devices with seeded faults, for tests of acquisition and of drivers.
//!
//! [`simulation`] plays whole runs of the protocol on a simulated rig; [`fault`] wraps one device.

pub mod fault;
pub mod simulation;
