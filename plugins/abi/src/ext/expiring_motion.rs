//! Extension of a robot that stops by itself if its motion is not renewed.

use core::ffi::c_void;

use crate::device::Stamp;
use crate::error::Error;
use crate::robot::Motion;
use crate::status::Status;

/// Id of this ability.
pub const EXPIRING_MOTION: &str = "taceva.robot.expiring-motion/1";

/// `taceva_expiring_motion_calls`, since minor 2.
///
/// New versions append fields. Each side reads at most the bytes that the other side's `size` states.
///
/// ```
/// use taceva_abi::ext::ExpiringMotionCalls;
/// let calls = ExpiringMotionCalls { size: size_of::<ExpiringMotionCalls>() as u32, reserved: 0, move_expiring: None };
/// assert!(calls.move_expiring.is_none(), "a host refuses a device that names this ability and lacks its function");
/// ```
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct ExpiringMotionCalls {
    /// Size of this struct, bytes.
    pub size: u32,
    /// Reserved, 0.
    pub reserved: u32,
    /// `[owner & open]` Moves the tip. The robot begins to brake within 200 ms after the process of the plugin ends.
    pub move_expiring: Option<
        unsafe extern "C" fn(
            *mut c_void,
            *const Motion,
            *mut Stamp,
            timeout_ns: u64,
            *mut Error,
        ) -> Status,
    >,
}
