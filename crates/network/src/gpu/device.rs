//! A device that was found, and how each programming interface finds one.

#[cfg(feature = "cuda")]
mod cuda;
#[cfg(feature = "wgpu")]
mod wgpu;

use crate::error::NetworkError;
use crate::gpu::{GpuError, GpuKind};
use crate::training::{Engine, Recipe, Snapshot};

/// A device that was found.
#[derive(Clone, Debug)]
pub(crate) struct Device {
    /// Its name, as its driver gives it.
    pub(crate) name: String,
    pub(crate) begin: Begin,
}

/// Begins a training on a device that errors call by this name, with the backend of burn that its kind has.
type Begin = fn(&str, &Snapshot, &Recipe) -> Result<Box<dyn Engine>, NetworkError>;

impl Device {
    /// The first device of `kind`.
    ///
    /// # Errors
    /// [`GpuError::NotBuilt`] without the feature for that kind, [`GpuError::NotFound`] without a device.
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
