//! The calls of a force transducer.

use core::ffi::c_void;

use crate::device::{DeviceCalls, Stamp};
use crate::error::Error;
use crate::status::Status;

/// `taceva_wrench`: what presses on the gel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct Wrench {
    /// N.
    pub force_n: [f64; 3],
    /// N m.
    pub torque_nm: [f64; 3],
}

/// `taceva_force_calls`.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct ForceCalls {
    /// What every device has.
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
