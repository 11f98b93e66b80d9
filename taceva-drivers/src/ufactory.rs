//! Drivers for robots of UFACTORY.

pub mod xarm;
