//! Function table of a changer.

use core::ffi::c_void;

use crate::device::DeviceCalls;
use crate::error::Error;
use crate::status::Status;
use crate::text::{TakeText, Text};

/// `taceva_changer_calls`, since minor 2.
///
/// New versions append fields. Each side reads at most the bytes that the other side's `size` states.
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
    /// Calls that every device has. The table begins with them.
    pub device: DeviceCalls,
    /// `[owner & open]` Brings the item `name` into place. `take` receives the name of the item in place, after the motion has ended.
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
