//! Robots of Universal Robots.

mod rtde;

pub use rtde::UrFactory;
