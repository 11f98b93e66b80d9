//! A GPU, and what can be asked of it.

use std::fmt;

use taceva_network::{Engine, NetworkError, Recipe, Snapshot};

use crate::GpuError;

/// How a GPU is reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GpuKind {
    /// NVIDIA's driver, with kernels that NVRTC compiles when they are first used.
    Cuda,
    /// Vulkan, Metal or DirectX 12, whichever the system has.
    Wgpu,
}

impl GpuKind {
    /// Every kind.
    pub const ALL: [GpuKind; 2] = [GpuKind::Cuda, GpuKind::Wgpu];

    /// Its name, which the feature has too.
    pub const fn name(self) -> &'static str {
        match self {
            GpuKind::Cuda => "cuda",
            GpuKind::Wgpu => "wgpu",
        }
    }

    /// Checks that this program was built with the feature for this kind.
    ///
    /// # Errors
    /// [`GpuError::NotBuilt`], naming the feature.
    pub const fn check_built(self) -> Result<(), GpuError> {
        let is_built = match self {
            GpuKind::Cuda => cfg!(feature = "cuda"),
            GpuKind::Wgpu => cfg!(feature = "wgpu"),
        };
        if is_built {
            Ok(())
        } else {
            Err(GpuError::NotBuilt { kind: self })
        }
    }
}

impl fmt::Display for GpuKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A GPU that was found.
#[derive(Clone, Debug)]
pub struct Gpu {
    pub(crate) kind: GpuKind,
    pub(crate) name: String,
    pub(crate) begin: Begin,
}

/// What begins a training on a GPU, with the backend of burn that its kind has.
pub(crate) type Begin = fn(&Gpu, &Snapshot, &Recipe) -> Result<Box<dyn Engine>, NetworkError>;

impl Gpu {
    /// The first GPU of `kind`.
    ///
    /// # Errors
    /// [`GpuError::NotBuilt`] if this program was built without the feature, [`GpuError::NotFound`] if there is no device.
    pub fn find(kind: GpuKind) -> Result<Gpu, GpuError> {
        match kind {
            #[cfg(feature = "cuda")]
            GpuKind::Cuda => crate::device::cuda::find(),
            #[cfg(feature = "wgpu")]
            GpuKind::Wgpu => crate::device::wgpu::find(),
            #[cfg(not(all(feature = "cuda", feature = "wgpu")))]
            kind => Err(GpuError::NotBuilt { kind }),
        }
    }

    /// How it is reached.
    pub const fn kind(&self) -> GpuKind {
        self.kind
    }

    /// Its name, as its driver gives it.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// A training on it that goes on from `snapshot`; what [`Trainer::on`](taceva_network::Trainer::on) asks for.
    ///
    /// # Errors
    /// [`NetworkError::Device`] if the device fails.
    pub fn engine(
        &self,
        snapshot: &Snapshot,
        recipe: &Recipe,
    ) -> Result<Box<dyn Engine>, NetworkError> {
        (self.begin)(self, snapshot, recipe)
    }
}

impl fmt::Display for Gpu {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({})", self.name, self.kind)
    }
}
