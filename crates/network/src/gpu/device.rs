//! Devices, and their detection by each programming interface.

#[cfg(feature = "cuda")]
mod cuda;
#[cfg(feature = "wgpu")]
mod wgpu;

use crate::error::NetworkError;
use crate::gpu::{GpuError, GpuKind};
use crate::training::{Engine, Recipe, Snapshot};

/// A device of this machine.
#[derive(Clone, Debug)]
pub(crate) struct Device {
    /// Name of the device as its driver reports it.
    pub(crate) name: String,
    pub(crate) begin: Begin,
}

/// Function that starts a training on a device, with the burn backend for its kind. The first argument names the device in errors.
type Begin = fn(&str, &Snapshot, &Recipe) -> Result<Box<dyn Engine>, NetworkError>;

impl Device {
    /// Finds the first device of `kind`.
    ///
    /// # Errors
    /// [`GpuError::NotBuilt`] without the feature for `kind`, [`GpuError::NotFound`] without a device.
    pub(crate) fn find(kind: GpuKind) -> Result<Device, GpuError> {
        match kind {
            #[cfg(feature = "cuda")]
            GpuKind::Cuda => cuda::find(),
            #[cfg(feature = "wgpu")]
            GpuKind::Wgpu => wgpu::find(),
            #[cfg(not(all(feature = "cuda", feature = "wgpu")))]
            kind => Err(GpuError::NotBuilt { kind }),
        }
    }
}
