//! A force transducer that can call the present load zero.

use core::ffi::c_void;

use crate::error::Error;
use crate::status::Status;

/// The id of the extension.
pub const TARE: &str = "taceva.force.tare/1";

/// `taceva_tare_calls`.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct TareCalls {
    /// Of this struct.
    pub size: u32,
    /// 0.
    pub reserved: u32,
    /// `[owner & started]` Returns once it holds.
    pub zero: Option<unsafe extern "C" fn(*mut c_void, timeout_ns: u64, *mut Error) -> Status>,
}
