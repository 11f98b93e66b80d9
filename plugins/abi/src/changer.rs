//! The calls of a changer.

use core::ffi::c_void;

use crate::device::DeviceCalls;
use crate::error::Error;
use crate::status::Status;
use crate::text::{TakeText, Text};

/// `taceva_changer_calls`, since minor 2.
///
/// A struct with a size in front grows at its end: a side reads no further than the other's `size` says.
///
/// ```
/// use taceva_abi::{ChangerCalls, DeviceCalls};
/// let device = DeviceCalls { size: size_of::<ChangerCalls>() as u32, reserved: 0, close: None, interrupt: None, extension: None };
/// let calls = ChangerCalls { device, bring: None };
/// assert_eq!(calls.device.size as usize, size_of::<ChangerCalls>());
/// ```
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct ChangerCalls {
    /// The calls that every device has; the table begins with them.
    pub device: DeviceCalls,
    /// `[owner & open]` Brings the item `name` into place; `take` receives the name of the item in place, once nothing moves.
    pub bring: Option<
        unsafe extern "C" fn(
            *mut c_void,
            name: Text,
            timeout_ns: u64,
            take: TakeText,
            context: *mut c_void,
            *mut Error,
        ) -> Status,
    >,
}
