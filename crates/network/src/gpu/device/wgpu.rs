//! wgpu devices.

use std::pin::pin;
use std::sync::Mutex;
use std::task::{Context, Poll, Waker};

use burn_wgpu::graphics::{AutoGraphicsApi, GraphicsApi};
use burn_wgpu::{Wgpu, WgpuDevice};
use taceva_core::contained;
use wgpu::{Backend, Instance, InstanceDescriptor, PowerPreference, RequestAdapterOptions};

use super::Device;
use crate::gpu::engine::begin;
use crate::gpu::{GpuError, GpuKind};

/// Name of the device after burn has initialised it. burn allows only one initialisation per process.
static READY: Mutex<Option<String>> = Mutex::new(None);

/// Finds the first wgpu device.
pub(crate) fn find() -> Result<Device, GpuError> {
    let backend = AutoGraphicsApi::backend();
    let refuse = |found: String| GpuError::NotFound {
        kind: GpuKind::Wgpu,
        looked_for: looked_for(backend),
        found,
    };
    let mut ready = READY
        .lock()
        .unwrap_or_else(std::sync::PoisonError::into_inner);
    let name = match &*ready {
        Some(name) => name.clone(),
        None => {
            let name = adapter(backend).map_err(refuse)?;
            let device = WgpuDevice::DefaultDevice;
            contained(|| burn_wgpu::init_setup::<AutoGraphicsApi>(&device, Default::default()))
                .map_err(|problem| refuse(format!("{name} cannot be used: {problem}")))?;
            ready.insert(name).clone()
        }
    };
    Ok(Device {
        name,
        begin: begin::<Wgpu>,
    })
}

const fn looked_for(backend: Backend) -> &'static str {
    match backend {
        Backend::Vulkan => "a Vulkan driver (libvulkan and a file in vulkan/icd.d)",
        Backend::Metal => "a Metal device",
        Backend::Dx12 => "a DirectX 12 device",
        _ => "a graphics adapter",
    }
}

/// Name of the adapter that burn would choose. The error is the reason why there is none.
fn adapter(backend: Backend) -> Result<String, String> {
    let instance = Instance::new(InstanceDescriptor {
        backends: backend.into(),
        ..InstanceDescriptor::new_without_display_handle()
    });
    let options = RequestAdapterOptions {
        power_preference: PowerPreference::HighPerformance,
        ..RequestAdapterOptions::default()
    };
    let future = pin!(instance.request_adapter(&options));
    // Outside browsers, the first poll returns the result.
    match future.poll(&mut Context::from_waker(Waker::noop())) {
        Poll::Ready(Ok(adapter)) => Ok(adapter.get_info().name),
        Poll::Ready(Err(error)) => Err(error.to_string()),
        Poll::Pending => Err("the graphics system returned no result at the first poll".to_owned()),
    }
}
