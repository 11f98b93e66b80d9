//! Drivers for arms of Universal Robots.

pub mod rtde;
