//! Programming interfaces of GPUs.

use std::fmt;

use crate::gpu::GpuError;

/// Programming interface of a GPU.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GpuKind {
    /// CUDA: NVIDIA's driver, with kernels compiled by NVRTC at first use.
    Cuda,
    /// wgpu: Vulkan, Metal or DirectX 12, depending on the system.
    Wgpu,
}

impl GpuKind {
    /// All kinds of programming interfaces.
    pub const ALL: [GpuKind; 2] = [GpuKind::Cuda, GpuKind::Wgpu];

    /// Name of the kind and of its Cargo feature.
    pub const fn name(self) -> &'static str {
        match self {
            GpuKind::Cuda => "cuda",
            GpuKind::Wgpu => "wgpu",
        }
    }

    /// Checks that this program was built with the feature for this kind.
    ///
    /// # Errors
    /// [`GpuError::NotBuilt`] with the name of the feature.
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
