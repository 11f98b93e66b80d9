#![doc = include_str!("../README.md")]

pub mod conformity;
mod fraction;
pub mod gauge;
mod quadrature;
