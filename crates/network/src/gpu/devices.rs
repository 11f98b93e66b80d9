//! Devices for tests.

/// Calls a test function of a backend for each kind of GPU that is built and present. Otherwise reports a skipped test.
macro_rules! on_each {
    ($check:ident) => {
        for kind in crate::gpu::GpuKind::ALL {
            if kind.check_built().is_err() {
                continue;
            }
            match crate::gpu::Gpu::find(kind) {
                Ok(_) => match kind {
                    #[cfg(feature = "cuda")]
                    crate::gpu::GpuKind::Cuda => $check::<burn_cuda::Cuda>(),
                    #[cfg(feature = "wgpu")]
                    crate::gpu::GpuKind::Wgpu => $check::<burn_wgpu::Wgpu>(),
                    #[cfg(not(all(feature = "cuda", feature = "wgpu")))]
                    _ => unreachable!("{kind} was not built"),
                },
                Err(reason) => taceva_needs::skip(taceva_needs::Need::Gpu, reason),
            }
        }
    };
}

pub(crate) use on_each;
