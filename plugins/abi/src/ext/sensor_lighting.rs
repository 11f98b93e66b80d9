//! A sensor that sets the light around it by itself.

use core::ffi::c_void;

use crate::error::Error;
use crate::status::Status;
use crate::text::Text;

/// The id of the extension.
pub const SENSOR_LIGHTING: &str = "taceva.sensor.lighting/1";

/// `taceva_sensor_lighting_calls`.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct SensorLightingCalls {
    /// Of this struct.
    pub size: u32,
    /// 0.
    pub reserved: u32,
    /// `[owner & open]` A scene of the manifest; returns once it holds.
    pub set: Option<
        unsafe extern "C" fn(*mut c_void, scene: Text, timeout_ns: u64, *mut Error) -> Status,
    >,
}
