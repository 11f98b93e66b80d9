//! A sensor that sets the light around itself.

use core::ffi::c_void;

use crate::error::Error;
use crate::status::Status;
use crate::text::Text;

/// Id of this ability.
pub const SENSOR_LIGHTING: &str = "taceva.sensor.lighting/1";

/// `taceva_sensor_lighting_calls`.
///
/// A struct with a size in front grows at its end: a side reads no further than the other's `size` says.
///
/// ```
/// use taceva_abi::ext::SensorLightingCalls;
/// let calls = SensorLightingCalls { size: size_of::<SensorLightingCalls>() as u32, reserved: 0, set: None };
/// assert!(calls.set.is_none(), "a host refuses a device that names this ability and lacks its function");
/// ```
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct SensorLightingCalls {
    /// The size of this struct, in bytes.
    pub size: u32,
    /// Reserved, 0.
    pub reserved: u32,
    /// `[owner & open]` Sets a scene of the manifest; returns once it is steady.
    pub set: Option<
        unsafe extern "C" fn(*mut c_void, scene: Text, timeout_ns: u64, *mut Error) -> Status,
    >,
}
