//! Extension of a sensor that controls its own lighting.

use core::ffi::c_void;

use crate::error::Error;
use crate::status::Status;
use crate::text::Text;

/// Id of this ability.
pub const SENSOR_LIGHTING: &str = "taceva.sensor.lighting/1";

/// `taceva_sensor_lighting_calls`: function of a sensor with its own lights.
///
/// New versions append fields. Each side reads at most the bytes that the other side's `size` states.
///
/// ```
/// use taceva_abi::ext::SensorLightingCalls;
/// let calls = SensorLightingCalls { size: size_of::<SensorLightingCalls>() as u32, reserved: 0, set: None };
/// assert!(calls.set.is_none(), "a host refuses a device that names this ability and lacks its function");
/// ```
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct SensorLightingCalls {
    /// Size of this struct, bytes.
    pub size: u32,
    /// Reserved, 0.
    pub reserved: u32,
    /// `[owner & open]` Sets a light scene of the manifest. Returns once the light is steady.
    pub set: Option<
        unsafe extern "C" fn(*mut c_void, scene: Text, timeout_ns: u64, *mut Error) -> Status,
    >,
}
