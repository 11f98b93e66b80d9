//! Finding a device, by whatever reaches it.

#[cfg(feature = "cuda")]
pub(crate) mod cuda;
#[cfg(feature = "wgpu-untuned")]
pub(crate) mod wgpu;
