//! The ways to reach a GPU.

use std::fmt;

use crate::gpu::GpuError;

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
