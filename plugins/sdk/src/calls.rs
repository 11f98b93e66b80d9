//! Functions with which the host calls an open device, by kind of device. Every function runs in a [`guard`] and checks its arguments with
//! [`memory`](crate::memory).

#![expect(unsafe_code, reason = "functions that a host calls")]

mod changer;
mod force;
mod lighting;
mod robot;
mod sensor;

use std::any::Any;
use std::ffi::c_void;

use taceva_abi::{DeviceCalls, Error, Status, Text};
use taceva_core::Facts;

use crate::driver_lists::{Drivers, Loaded};
use crate::failure::Failure;
use crate::guard::{caught, guard};
use crate::handles::{self, Handle};
use crate::memory;

/// Kind of device: the type of an open device, and the table of functions with which the host calls such a device.
pub(crate) trait Kind: 'static {
    /// Type of an open device, which the host addresses by a handle.
    type Opened: Any + Send;
    /// Table of functions for this kind of device.
    type Calls: 'static;
    const CALLS: &'static Self::Calls;

    /// Drivers of this kind in the plugin.
    fn drivers(loaded: &Loaded) -> &Drivers<Self>;

    /// Wraps the open `device` for a handle. `facts` are the declared facts of its driver.
    fn handle(device: Box<Self>, facts: &Facts) -> Handle<Self::Opened>;
}

/// Functions that every device has. `T` is the function table of the kind, and `O` the type of an open device.
const fn device_calls<T, O: Any + Send>(
    extension: unsafe extern "C" fn(*mut c_void, Text) -> *const c_void,
) -> DeviceCalls {
    #[expect(clippy::cast_possible_truncation, reason = "a hundred bytes")]
    let size = size_of::<T>() as u32;
    DeviceCalls {
        size,
        reserved: 0,
        close: Some(close),
        interrupt: Some(interrupt::<O>),
        extension: Some(extension),
    }
}

unsafe extern "C" fn close(handle: *mut c_void) {
    handles::close(handle);
}

unsafe extern "C" fn interrupt<O: Any + Send>(handle: *mut c_void) {
    // The call returns no status, so failures are ignored.
    drop(caught(|| {
        if let Ok(handle) = handles::find::<Handle<O>>(handle) {
            handle
                .interrupt
                .iter()
                .for_each(|interrupt| interrupt.interrupt());
        }
    }));
}

/// Runs `work` with exclusive access to the open device, of type `O`, that has this `handle`.
///
/// # Safety
/// `error` is valid, as for [`guard`].
unsafe fn call<O: Any + Send>(
    handle: *mut c_void,
    error: *mut Error,
    work: impl FnOnce(&mut O) -> Result<(), Failure>,
) -> Status {
    // SAFETY: guaranteed by the caller.
    unsafe { guard(error, || handles::find::<Handle<O>>(handle)?.call(work)) }
}

/// Returns the extension table `calls` if the requested `id` equals `name`, and `has` returns true for the device; otherwise NULL.
///
/// # Safety
/// The text `id` stays unchanged during the call.
unsafe fn extended<O: Any + Send, T>(
    handle: *mut c_void,
    id: Text,
    name: &str,
    calls: &'static T,
    has: impl FnOnce(&mut O) -> bool,
) -> *const c_void {
    let has = || {
        // SAFETY: guaranteed by the caller.
        if unsafe { memory::text("id", id) }? != name {
            return Ok(false);
        }
        handles::find::<Handle<O>>(handle)?.call(|device| Ok(has(device)))
    };
    match caught(has) {
        Ok(Ok(true)) => std::ptr::from_ref(calls).cast(),
        _ => std::ptr::null(),
    }
}
