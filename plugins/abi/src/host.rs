//! Services of the host for a plugin: log and clock.

use core::ffi::c_void;

use crate::text::Text;

/// `taceva_host`; it outlives everything that a plugin makes.
///
/// A struct with a size in front grows at its end: a side reads no further than the other's `size` says.
///
/// ```
/// use std::ffi::c_void;
/// use taceva_abi::{ABI_MINOR, Host};
/// unsafe extern "C" fn now_ns(_: *mut c_void) -> u64 {
///     1_000
/// }
/// let host = Host {
///     size: size_of::<Host>() as u32,
///     abi_minor: ABI_MINOR,
///     context: std::ptr::null_mut(),
///     log: None,
///     now_ns: Some(now_ns),
/// };
/// // SAFETY: the function takes any context.
/// assert_eq!(unsafe { now_ns(host.context) }, 1_000);
/// ```
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Host {
    /// The size of this struct, in bytes.
    pub size: u32,
    /// The minor version that the host knows.
    pub abi_minor: u32,
    /// Passed with every call.
    pub context: *mut c_void,
    /// `[any]` Takes a line of the log.
    pub log: Option<unsafe extern "C" fn(*mut c_void, level: i32, target: Text, message: Text)>,
    /// `[any]` The time of `CLOCK_MONOTONIC`, in ns.
    pub now_ns: Option<unsafe extern "C" fn(*mut c_void) -> u64>,
}

/// Severity of a line of the log.
///
/// Crosses the boundary as a number; an unlisted number counts as [`Level::Debug`].
///
/// ```
/// use taceva_abi::Level;
/// assert!(Level::Error < Level::Debug);
/// assert_eq!(Level::Warn as i32, 2);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[repr(i32)]
#[non_exhaustive]
pub enum Level {
    /// Something failed.
    Error = 1,
    /// Something is odd.
    Warn = 2,
    /// Something happened.
    Info = 3,
    /// Detail for debugging.
    Debug = 4,
}
