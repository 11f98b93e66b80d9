//! Gauge studies: components of variance of a measuring system.
#![doc = include_str!("../README.md")]

pub mod budget;
pub mod curve;
pub mod gauge;
mod numerics;
