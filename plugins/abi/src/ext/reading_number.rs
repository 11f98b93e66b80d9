//! Extension of a force transducer that numbers its readings.

use core::ffi::c_void;

use crate::error::Error;
use crate::status::Status;

/// Id of this ability.
pub const NUMBERED: &str = "taceva.force.numbered/1";

/// `taceva_numbered_calls`: function of a force transducer that numbers its readings.
///
/// New versions append fields. Each side reads at most the bytes that the other side's `size` states.
///
/// ```
/// use taceva_abi::ext::NumberedCalls;
/// let calls = NumberedCalls { size: size_of::<NumberedCalls>() as u32, reserved: 0, sequence: None };
/// assert!(calls.sequence.is_none(), "a host refuses a device that names this ability and lacks its function");
/// ```
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct NumberedCalls {
    /// Size of this struct, bytes.
    pub size: u32,
    /// Reserved, 0.
    pub reserved: u32,
    /// `[owner & open]` Writes the number that the device assigned to the last reading. Returns `NOT_FOUND` before the first reading.
    pub sequence: Option<unsafe extern "C" fn(*mut c_void, *mut u64, *mut Error) -> Status>,
}
