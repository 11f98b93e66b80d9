#![doc = include_str!("../README.md")]

pub mod agreement;
pub mod conformity;
mod fraction;
pub mod gauge;
mod quadrature;
pub mod tolerance;
