#![doc = include_str!("../README.md")]

pub mod displacement;
pub mod elastic;
pub mod random;
