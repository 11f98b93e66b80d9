//! Training on a GPU with burn. Architectures, weights and recipes are the same as on the CPU.

#[cfg(any(feature = "cuda", feature = "wgpu"))]
mod autodiff;
#[cfg(any(feature = "cuda", feature = "wgpu"))]
mod convolution;
mod device;
#[cfg(all(test, any(feature = "cuda", feature = "wgpu")))]
mod devices;
#[cfg(any(feature = "cuda", feature = "wgpu"))]
mod engine;
mod error;
#[cfg(any(feature = "cuda", feature = "wgpu"))]
mod guard;
mod kind;
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
mod training;
#[cfg(any(feature = "cuda", feature = "wgpu"))]
mod weights;
#[cfg(any(feature = "cuda", feature = "wgpu"))]
mod windows;

use std::fmt;

use self::device::Device;
pub use self::error::GpuError;
pub use self::kind::GpuKind;
use crate::error::NetworkError;
use crate::training::{Engine, Recipe, Snapshot};

/// A GPU of this machine.
#[derive(Clone, Debug)]
pub struct Gpu {
    kind: GpuKind,
    device: Device,
}

impl Gpu {
    /// Finds the first GPU of `kind`.
    ///
    /// # Errors
    /// [`GpuError::NotBuilt`] if this program was built without the feature for `kind`, [`GpuError::NotFound`] if there is no device.
    pub fn find(kind: GpuKind) -> Result<Gpu, GpuError> {
        let device = Device::find(kind)?;
        Ok(Gpu { kind, device })
    }

    /// Programming interface of the GPU.
    pub const fn kind(&self) -> GpuKind {
        self.kind
    }

    /// Name of the GPU as its driver reports it.
    pub fn name(&self) -> &str {
        &self.device.name
    }

    /// Starts an engine on this GPU that continues from `snapshot`. Pass it to [`Trainer::on`](crate::Trainer::on).
    ///
    /// # Errors
    /// [`NetworkError::Device`] if the device fails.
    pub fn engine(
        &self,
        snapshot: &Snapshot,
        recipe: &Recipe,
    ) -> Result<Box<dyn Engine>, NetworkError> {
        (self.device.begin)(&self.to_string(), snapshot, recipe)
    }
}

impl fmt::Display for Gpu {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({})", self.device.name, self.kind)
    }
}
