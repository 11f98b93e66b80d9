//! What the host offers to a plugin.

use core::ffi::c_void;

use crate::text::Text;

/// `taceva_host`; it outlives everything that a plugin makes.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Host {
    /// Of this struct.
    pub size: u32,
    /// The minor version that the host knows.
    pub abi_minor: u32,
    /// Handed back with every call.
    pub context: *mut c_void,
    /// `[any]` Takes a line of the log.
    pub log: Option<unsafe extern "C" fn(*mut c_void, level: i32, target: Text, message: Text)>,
    /// `[any]` CLOCK_MONOTONIC.
    pub now_ns: Option<unsafe extern "C" fn(*mut c_void) -> u64>,
}

/// How much a line of the log matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[repr(i32)]
pub enum Level {
    /// Something failed.
    Error = 1,
    /// Something is odd.
    Warn = 2,
    /// Something happened.
    Info = 3,
    /// For whoever looks for a fault.
    Debug = 4,
}
