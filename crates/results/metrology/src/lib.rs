#![doc = include_str!("../README.md")]

pub mod agreement;
pub mod budget;
pub mod conformity;
pub mod curve;
pub mod gauge;
pub mod tolerance;
