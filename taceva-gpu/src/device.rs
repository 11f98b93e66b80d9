//! Finding a device, through each programming interface.

#[cfg(feature = "cuda")]
pub(crate) mod cuda;
#[cfg(feature = "wgpu-untuned")]
pub(crate) mod wgpu;
