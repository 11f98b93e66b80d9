#![doc = include_str!("../README.md")]

mod error;
mod gpu;

#[cfg(any(feature = "cuda", feature = "wgpu"))]
mod convolution;
#[cfg(any(feature = "cuda", feature = "wgpu"))]
mod device;
#[cfg(all(test, any(feature = "cuda", feature = "wgpu")))]
mod devices;
#[cfg(any(feature = "cuda", feature = "wgpu"))]
mod engine;
#[cfg(any(feature = "cuda", feature = "wgpu"))]
mod guard;
#[cfg(any(feature = "cuda", feature = "wgpu"))]
mod normalisation;
#[cfg(any(feature = "cuda", feature = "wgpu"))]
mod parts;
#[cfg(any(feature = "cuda", feature = "wgpu"))]
mod passes;
#[cfg(any(feature = "cuda", feature = "wgpu"))]
mod prediction;
#[cfg(any(feature = "cuda", feature = "wgpu"))]
mod products;
#[cfg(any(feature = "cuda", feature = "wgpu"))]
mod tracked;
#[cfg(any(feature = "cuda", feature = "wgpu"))]
mod training;
#[cfg(any(feature = "cuda", feature = "wgpu"))]
mod weights;
#[cfg(any(feature = "cuda", feature = "wgpu"))]
mod windows;

pub use error::GpuError;
pub use gpu::{Gpu, GpuKind};
