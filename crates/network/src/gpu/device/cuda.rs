//! CUDA devices.

use burn_cuda::Cuda;
use cudarc::driver::result as driver;
use cudarc::nvrtc;
use taceva_core::contained;

use super::Device;
use crate::gpu::engine::begin;
use crate::gpu::{GpuError, GpuKind};

/// Requirements for a CUDA device, for error messages.
const LOOKED_FOR: &str =
    "NVIDIA's driver (libcuda), its compiler NVRTC (libnvrtc of CUDA 11 or later) and a GPU";

/// Finds the first CUDA device.
pub(crate) fn find() -> Result<Device, GpuError> {
    // cudarc panics if a library is missing, and offers no other check.
    let found = contained(|| {
        let name = driver::init()
            .and_then(|()| driver::device::get(0))
            .and_then(driver::device::get_name)
            .map_err(|error| format!("driver error: {error}"))?;
        match nvrtc::compile_ptx("") {
            Ok(_) => Ok(name),
            Err(error) => Err(format!("NVRTC error: {error}")),
        }
    });
    let name = found
        .and_then(|name| name)
        .map_err(|found| GpuError::NotFound {
            kind: GpuKind::Cuda,
            looked_for: LOOKED_FOR,
            found,
        })?;
    Ok(Device {
        name,
        begin: begin::<Cuda>,
    })
}
