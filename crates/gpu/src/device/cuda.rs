//! A device by way of CUDA.

use burn_cuda::Cuda;
use cudarc::driver::result as driver;
use cudarc::nvrtc;

use crate::engine::begin;
use crate::guard::contained_quietly;
use crate::{Gpu, GpuError, GpuKind};

/// What is needed.
const LOOKED_FOR: &str =
    "NVIDIA's driver (libcuda), its compiler NVRTC (libnvrtc of CUDA 11 or later) and a GPU";

/// The first device.
pub(crate) fn find() -> Result<Gpu, GpuError> {
    // A library that is not there makes cudarc panic, and it has no other way to ask.
    let found = contained_quietly(|| {
        let name = driver::init()
            .and_then(|()| driver::device::get(0))
            .and_then(driver::device::get_name)
            .map_err(|error| format!("the driver says {error}"))?;
        match nvrtc::compile_ptx("") {
            Ok(_) => Ok(name),
            Err(error) => Err(format!("NVRTC says {error}")),
        }
    });
    let name = found
        .and_then(|name| name)
        .map_err(|found| GpuError::NotFound {
            kind: GpuKind::Cuda,
            looked_for: LOOKED_FOR,
            found,
        })?;
    Ok(Gpu {
        kind: GpuKind::Cuda,
        name,
        begin: begin::<Cuda>,
    })
}
