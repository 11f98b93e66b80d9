//! Function table of a force transducer.

use core::ffi::c_void;

use crate::device::{DeviceCalls, Stamp};
use crate::error::Error;
use crate::status::Status;

/// `taceva_wrench`: force and torque on the gel.
///
/// Frozen, because the caller allocates exactly this size.
///
/// ```
/// use taceva_abi::Wrench;
/// let pressed = Wrench { force_n: [0.0, 0.0, 1.5], ..Wrench::default() };
/// assert_eq!(pressed.torque_n_mm, [0.0; 3]);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct Wrench {
    /// Force along x, y and z, N.
    pub force_n: [f64; 3],
    /// Torque about x, y and z, N·mm.
    pub torque_n_mm: [f64; 3],
}

/// `taceva_force_calls`: functions of a force transducer.
///
/// New versions append fields. Each side reads at most the bytes that the other side's `size` states.
///
/// ```
/// use taceva_abi::{DeviceCalls, ForceCalls};
/// let device = DeviceCalls { size: size_of::<ForceCalls>() as u32, reserved: 0, close: None, interrupt: None, extension: None };
/// let calls = ForceCalls { device, start: None, read: None, stop: None, lost: None };
/// assert!(calls.start.is_none(), "it reads without being started");
/// ```
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct ForceCalls {
    /// Calls that every device has. The table begins with them.
    pub device: DeviceCalls,
    /// `[owner & open]` Starts the readings; idempotent.
    pub start: Option<unsafe extern "C" fn(*mut c_void, timeout_ns: u64, *mut Error) -> Status>,
    /// `[owner & started]` Waits for the next reading and writes it.
    pub read: Option<
        unsafe extern "C" fn(
            *mut c_void,
            *mut Wrench,
            *mut Stamp,
            timeout_ns: u64,
            *mut Error,
        ) -> Status,
    >,
    /// `[owner & open]` Stops the readings; idempotent.
    pub stop: Option<unsafe extern "C" fn(*mut c_void, *mut Error) -> Status>,
    /// `[owner & open]` Writes the number of readings lost since the opening. Returns `NOT_FOUND` if they are not counted. Since minor 4.
    pub lost: Option<unsafe extern "C" fn(*mut c_void, *mut u64, *mut Error) -> Status>,
}
