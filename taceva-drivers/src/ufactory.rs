//! Robots of UFACTORY.

pub mod xarm;
