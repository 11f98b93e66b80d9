#![doc = include_str!("../README.md")]

mod convolution;
mod isa;
mod panel;
mod planes;
mod random;
mod simd;

pub use isa::{Isa, IsaError};
pub use planes::Picture;
