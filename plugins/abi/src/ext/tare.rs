//! Extension of a force transducer that can set the present load as zero.

use core::ffi::c_void;

use crate::error::Error;
use crate::status::Status;

/// Id of this ability.
pub const TARE: &str = "taceva.force.tare/1";

/// `taceva_tare_calls`: function of a force transducer that sets its zero.
///
/// New versions append fields. Each side reads at most the bytes that the other side's `size` states.
///
/// ```
/// use taceva_abi::ext::TareCalls;
/// let calls = TareCalls { size: size_of::<TareCalls>() as u32, reserved: 0, zero: None };
/// assert!(calls.zero.is_none(), "a host refuses a device that names this ability and lacks its function");
/// ```
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct TareCalls {
    /// Size of this struct, bytes.
    pub size: u32,
    /// Reserved, 0.
    pub reserved: u32,
    /// `[owner & started]` Sets the present load as zero. Returns once readings have the new zero.
    pub zero: Option<unsafe extern "C" fn(*mut c_void, timeout_ns: u64, *mut Error) -> Status>,
}
