#![doc = include_str!("../README.md")]

pub mod agreement;
pub mod budget;
pub mod conformity;
pub mod curve;
mod fraction;
pub mod gauge;
mod quadrature;
pub mod tolerance;
