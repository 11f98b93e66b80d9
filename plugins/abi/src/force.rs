//! The calls of a force transducer.

use core::ffi::c_void;

use crate::device::{DeviceCalls, Stamp};
use crate::error::Error;
use crate::status::Status;

/// `taceva_wrench`: force and torque on the gel.
///
/// Frozen: the caller has room for exactly this.
///
/// ```
/// use taceva_abi::Wrench;
/// let pressed = Wrench { force_n: [0.0, 0.0, 1.5], ..Wrench::default() };
/// assert_eq!(pressed.torque_n_mm, [0.0; 3]);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct Wrench {
    /// The force along x, y and z, in N.
    pub force_n: [f64; 3],
    /// The torque about x, y and z, in N·mm.
    pub torque_n_mm: [f64; 3],
}

/// `taceva_force_calls`.
///
/// A struct with a size in front grows at its end: a side reads no further than the other's `size` says.
///
/// ```
/// use taceva_abi::{DeviceCalls, ForceCalls};
/// let device = DeviceCalls { size: size_of::<ForceCalls>() as u32, reserved: 0, close: None, interrupt: None, extension: None };
/// let calls = ForceCalls { device, start: None, read: None, stop: None };
/// assert!(calls.start.is_none(), "it reads without being started");
/// ```
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct ForceCalls {
    /// The calls that every device has; the table begins with them.
    pub device: DeviceCalls,
    /// `[owner & open]` Idempotent.
    pub start: Option<unsafe extern "C" fn(*mut c_void, timeout_ns: u64, *mut Error) -> Status>,
    /// `[owner & started]` The next reading.
    pub read: Option<
        unsafe extern "C" fn(
            *mut c_void,
            *mut Wrench,
            *mut Stamp,
            timeout_ns: u64,
            *mut Error,
        ) -> Status,
    >,
    /// `[owner & open]` Idempotent.
    pub stop: Option<unsafe extern "C" fn(*mut c_void, *mut Error) -> Status>,
}
