//! Robots of UFACTORY.

mod xarm;

pub use xarm::XarmFactory;
