//! The calls on an open device, kind by kind; every function takes what it is given through [`guard`] and [`memory`](crate::memory).

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

/// A kind of device: what is behind its handles, and the calls on them.
pub(crate) trait Kind: 'static {
    /// What is behind a handle.
    type Opened: Any + Send;
    /// The calls of its table.
    type Calls: 'static;
    const CALLS: &'static Self::Calls;

    /// Its drivers.
    fn drivers(loaded: &Loaded) -> &Drivers<Self>;

    /// What is put behind a handle: a device of which `facts` are known.
    fn handle(device: Box<Self>, facts: &Facts) -> Handle<Self::Opened>;
}

/// The calls that every device has, for a table of type `T` and what is behind its handles.
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
    // A call without an answer: there is nobody to report a failure to.
    drop(caught(|| {
        if let Ok(handle) = handles::find::<Handle<O>>(handle) {
            handle
                .interrupt
                .iter()
                .for_each(|interrupt| interrupt.interrupt());
        }
    }));
}

/// Does `work` on the device behind `handle`, alone.
///
/// # Safety
/// As [`guard`].
unsafe fn call<O: Any + Send>(
    handle: *mut c_void,
    error: *mut Error,
    work: impl FnOnce(&mut O) -> Result<(), Failure>,
) -> Status {
    // SAFETY: promised by the caller.
    unsafe { guard(error, || handles::find::<Handle<O>>(handle)?.call(work)) }
}

/// The table `calls` where `id` is the name of it and the device `has` that ability; NULL where not.
///
/// # Safety
/// `id` is lent for the call.
unsafe fn extended<O: Any + Send, T>(
    handle: *mut c_void,
    id: Text,
    name: &str,
    calls: &'static T,
    has: impl FnOnce(&mut O) -> bool,
) -> *const c_void {
    let has = || {
        // SAFETY: promised by the caller.
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
