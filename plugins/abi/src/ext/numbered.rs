//! A force transducer that numbers its readings.

use core::ffi::c_void;

use crate::error::Error;
use crate::status::Status;

/// Id of this ability.
pub const NUMBERED: &str = "taceva.force.numbered/1";

/// `taceva_numbered_calls`.
///
/// A struct with a size in front grows at its end: a side reads no further than the other's `size` says.
///
/// ```
/// use taceva_abi::ext::NumberedCalls;
/// let calls = NumberedCalls { size: size_of::<NumberedCalls>() as u32, reserved: 0, sequence: None };
/// assert!(calls.sequence.is_none(), "a host refuses a device that names this ability and lacks its function");
/// ```
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct NumberedCalls {
    /// The size of this struct, in bytes.
    pub size: u32,
    /// Reserved, 0.
    pub reserved: u32,
    /// `[owner & open]` The number that the device itself gave the last reading; `NOT_FOUND` before the first.
    pub sequence: Option<unsafe extern "C" fn(*mut c_void, *mut u64, *mut Error) -> Status>,
}
