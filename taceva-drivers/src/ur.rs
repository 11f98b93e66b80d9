//! Robots of Universal Robots.

pub mod rtde;
