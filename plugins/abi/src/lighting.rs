//! Function table of a lighting device.

use core::ffi::c_void;

use crate::device::DeviceCalls;
use crate::error::Error;
use crate::status::Status;
use crate::text::Text;

/// `taceva_lighting_calls`: functions of a lighting device.
///
/// New versions append fields. Each side reads at most the bytes that the other side's `size` states.
///
/// ```
/// use taceva_abi::{DeviceCalls, LightingCalls};
/// let device = DeviceCalls { size: size_of::<LightingCalls>() as u32, reserved: 0, close: None, interrupt: None, extension: None };
/// let calls = LightingCalls { device, set: None };
/// assert_eq!(calls.device.size as usize, size_of::<LightingCalls>());
/// ```
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct LightingCalls {
    /// Calls that every device has. The table begins with them.
    pub device: DeviceCalls,
    /// `[owner & open]` Sets a light scene. Returns once the light is steady.
    pub set: Option<
        unsafe extern "C" fn(*mut c_void, scene: Text, timeout_ns: u64, *mut Error) -> Status,
    >,
}
