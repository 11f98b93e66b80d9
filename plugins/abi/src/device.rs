//! Types that every kind of device shares.

use core::ffi::c_void;
use core::marker::{PhantomData, PhantomPinned};

use crate::args::Args;
use crate::error::Error;
use crate::status::Status;
use crate::text::{TakeText, Text};

/// `taceva_stamp`: times at which an observation was valid and received.
///
/// Frozen, because other structs contain a `Stamp`.
///
/// ```
/// use taceva_abi::Stamp;
/// let measured = Stamp { valid_ns: 20_000_000, ..Stamp::default() };
/// assert_eq!(measured.received_ns, 0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(C)]
pub struct Stamp {
    /// Time at which the observation was valid, in ns of the clock of the device.
    pub valid_ns: u64,
    /// Time at which the host received the observation, in ns; 0 if unknown.
    pub received_ns: u64,
}

/// `taceva_rig`: opaque handle of the devices that are opened together. Only the plugin reads its contents. A host keeps the pointer that `open_rig`
/// wrote and passes the pointer back.
///
/// ```
/// use taceva_abi::Rig;
/// let rig: *mut Rig = std::ptr::null_mut(); // NULL: the device has no rig
/// assert!(rig.is_null());
/// ```
#[repr(C)]
pub struct Rig {
    opaque: [u8; 0],
    not_movable: PhantomData<(*mut u8, PhantomPinned)>,
}

/// `taceva_device_calls`: the calls that every device has. Frozen: the struct never grows.
///
/// ```
/// use std::ffi::c_void;
/// use taceva_abi::{DeviceCalls, ForceCalls};
/// unsafe extern "C" fn close(_: *mut c_void) {}
/// let calls = DeviceCalls { size: size_of::<ForceCalls>() as u32, reserved: 0, close: Some(close), interrupt: None, extension: None };
/// assert!(calls.interrupt.is_none(), "its calls never wait");
/// ```
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct DeviceCalls {
    /// Size of the whole table for the kind of device, bytes.
    pub size: u32,
    /// Reserved, 0.
    pub reserved: u32,
    /// `[owner & open]` Stops the device and frees it; the last call.
    pub close: Option<unsafe extern "C" fn(handle: *mut c_void)>,
    /// `[any & open]` Makes a blocked call return `INTERRUPTED` within 50 ms. No effect if no call is blocked.
    pub interrupt: Option<unsafe extern "C" fn(handle: *mut c_void)>,
    /// `[owner & open]` Returns a table of calls on the device, or NULL.
    pub extension: Option<unsafe extern "C" fn(handle: *mut c_void, id: Text) -> *const c_void>,
}

/// `taceva_device`: an open device, filled in by `open`.
///
/// Frozen, because the caller allocates exactly this size.
///
/// ```
/// use taceva_abi::Device;
/// let place = Device { handle: std::ptr::null_mut(), calls: std::ptr::null() }; // empty struct that `open` fills
/// assert!(place.calls.is_null());
/// ```
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Device {
    /// Plugin's own handle of the device, passed with every call.
    pub handle: *mut c_void,
    /// Table of calls for the kind of device. Valid as long as the library is loaded.
    pub calls: *const DeviceCalls,
}

/// `taceva_factory`: the drivers of one kind, numbered from 0.
///
/// New versions append fields. Each side reads at most the bytes that the other side's `size` states.
///
/// ```
/// use taceva_abi::Factory;
/// let none = Factory { size: size_of::<Factory>() as u32, drivers: 0, describe: None, discover: None, open: None };
/// assert_eq!(none.drivers, 0);
/// ```
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Factory {
    /// Size of this struct, bytes.
    pub size: u32,
    /// Number of drivers of this kind in the plugin.
    pub drivers: u32,
    /// `[any]` Writes the `[[provides]]` table of the manifest for the given arguments; NULL means any arguments. Accesses no device.
    pub describe:
        Option<unsafe extern "C" fn(u32, *const Args, TakeText, *mut c_void, *mut Error) -> Status>,
    /// `[any]` Lists the connected devices, each by the arguments that select it.
    pub discover: Option<unsafe extern "C" fn(u32, TakeText, *mut c_void, *mut Error) -> Status>,
    /// `[any]` Opens a device without any motion or change of light.
    pub open:
        Option<unsafe extern "C" fn(u32, *const Args, *mut Rig, *mut Device, *mut Error) -> Status>,
}
