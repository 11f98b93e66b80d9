//! The calls of a lighting.

use core::ffi::c_void;

use crate::device::DeviceCalls;
use crate::error::Error;
use crate::status::Status;
use crate::text::Text;

/// `taceva_lighting_calls`.
///
/// A struct with a size in front grows at its end: a side reads no further than the other's `size` says.
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
    /// The calls that every device has; the table begins with them.
    pub device: DeviceCalls,
    /// `[owner & open]` Sets a scene; returns once it is steady.
    pub set: Option<
        unsafe extern "C" fn(*mut c_void, scene: Text, timeout_ns: u64, *mut Error) -> Status,
    >,
}
