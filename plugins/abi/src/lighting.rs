//! The calls of a lighting.

use core::ffi::c_void;

use crate::device::DeviceCalls;
use crate::error::Error;
use crate::status::Status;
use crate::text::Text;

/// `taceva_lighting_calls`.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct LightingCalls {
    /// What every device has.
    pub device: DeviceCalls,
    /// `[owner & open]` Returns once the scene holds.
    pub set: Option<
        unsafe extern "C" fn(*mut c_void, scene: Text, timeout_ns: u64, *mut Error) -> Status,
    >,
}
