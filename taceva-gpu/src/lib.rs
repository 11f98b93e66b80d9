#![doc = include_str!("../README.md")]

mod error;
mod gpu;

#[cfg(any(feature = "cuda", feature = "wgpu-untuned"))]
mod convolution;
#[cfg(any(feature = "cuda", feature = "wgpu-untuned"))]
mod device;
#[cfg(any(feature = "cuda", feature = "wgpu-untuned"))]
mod engine;
#[cfg(any(feature = "cuda", feature = "wgpu-untuned"))]
mod guard;
#[cfg(any(feature = "cuda", feature = "wgpu-untuned"))]
mod normalisation;
#[cfg(any(feature = "cuda", feature = "wgpu-untuned"))]
mod passes;
#[cfg(any(feature = "cuda", feature = "wgpu-untuned"))]
mod prediction;
#[cfg(any(feature = "cuda", feature = "wgpu-untuned"))]
mod products;
#[cfg(any(feature = "cuda", feature = "wgpu-untuned"))]
mod tracked;
#[cfg(any(feature = "cuda", feature = "wgpu-untuned"))]
mod training;
#[cfg(any(feature = "cuda", feature = "wgpu-untuned"))]
mod weights;
#[cfg(any(feature = "cuda", feature = "wgpu-untuned"))]
mod windows;

pub use error::GpuError;
pub use gpu::{Gpu, GpuKind};
