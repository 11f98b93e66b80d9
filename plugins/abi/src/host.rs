//! Services of the host for a plugin: log and clock.

use core::ffi::c_void;

use crate::text::Text;

/// `taceva_host`: table of services. The table outlives all objects of a plugin.
///
/// New versions append fields. Each side reads at most the bytes that the other side's `size` states.
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
    /// Size of this struct, bytes.
    pub size: u32,
    /// Minor version of the interface that the host implements.
    pub abi_minor: u32,
    /// Context of the host, passed with every call.
    pub context: *mut c_void,
    /// `[any]` Logs a line.
    pub log: Option<unsafe extern "C" fn(*mut c_void, level: i32, target: Text, message: Text)>,
    /// `[any]` Returns the time of `CLOCK_MONOTONIC`, ns.
    pub now_ns: Option<unsafe extern "C" fn(*mut c_void) -> u64>,
}

/// Level of a log line, passed as a number. The host treats an unlisted number as [`Level::Debug`].
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
    /// A failure.
    Error = 1,
    /// An unexpected condition.
    Warn = 2,
    /// An event.
    Info = 3,
    /// Details for debugging.
    Debug = 4,
}
