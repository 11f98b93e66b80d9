//! Functions with which the host calls a changer of specimens or units.

#![expect(unsafe_code, reason = "functions that a host calls")]

use std::ffi::c_void;
use std::ptr::null;

use taceva_abi::{ChangerCalls, Error, Status, TakeText, Text};
use taceva_core::{Changer, Facts};

use super::{Kind, call, device_calls};
use crate::convert::deadline;
use crate::driver_lists::{Drivers, Loaded};
use crate::failure::Failure;
use crate::handles::Handle;
use crate::memory;

type Opened = Box<dyn Changer>;

impl Kind for dyn Changer {
    type Opened = Opened;
    type Calls = ChangerCalls;
    const CALLS: &'static ChangerCalls = &CALLS;

    fn drivers(loaded: &Loaded) -> &Drivers<dyn Changer> {
        &loaded.changers
    }

    fn handle(changer: Box<dyn Changer>, _: &Facts) -> Handle<Opened> {
        let interrupt = changer.interrupt_handle();
        Handle::new(changer).interrupted_by(interrupt)
    }
}

static CALLS: ChangerCalls = ChangerCalls {
    device: device_calls::<ChangerCalls, Opened>(extension),
    bring: Some(bring),
};

unsafe extern "C" fn extension(_: *mut c_void, _: Text) -> *const c_void {
    null()
}

unsafe extern "C" fn bring(
    handle: *mut c_void,
    name: Text,
    timeout_ns: u64,
    take: TakeText,
    context: *mut c_void,
    error: *mut Error,
) -> Status {
    let work = |changer: &mut Opened| {
        // SAFETY: the host lends the text for the call.
        let name = unsafe { memory::text("name", name) }?;
        if take.is_none() {
            return Err(Failure::argument("`take` is NULL"));
        }
        let there = changer.bring(name, deadline(timeout_ns))?;
        // SAFETY: the host passes its own function and context.
        unsafe { memory::hand(take, context, &there) }
    };
    // SAFETY: the host guarantees that `error` is valid.
    unsafe { call(handle, error, work) }
}
