#![doc = include_str!("../README.md")]

mod fraction;
pub mod gauge;
mod quadrature;
