//! Functions with which the host calls a lighting device.

#![expect(unsafe_code, reason = "functions that a host calls")]

use std::ffi::c_void;
use std::ptr::null;

use taceva_abi::{Error, LightingCalls, Status, Text};
use taceva_core::{Facts, Lighting};

use super::{Kind, call, device_calls};
use crate::convert::deadline;
use crate::driver_lists::{Drivers, Loaded};
use crate::handles::Handle;
use crate::memory;

type Opened = Box<dyn Lighting>;

impl Kind for dyn Lighting {
    type Opened = Opened;
    type Calls = LightingCalls;
    const CALLS: &'static LightingCalls = &CALLS;

    fn drivers(loaded: &Loaded) -> &Drivers<dyn Lighting> {
        &loaded.lightings
    }

    fn handle(device: Box<dyn Lighting>, _: &Facts) -> Handle<Opened> {
        Handle::new(device)
    }
}

static CALLS: LightingCalls = LightingCalls {
    device: device_calls::<LightingCalls, Opened>(extension),
    set: Some(set),
};

unsafe extern "C" fn extension(_: *mut c_void, _: Text) -> *const c_void {
    null()
}

unsafe extern "C" fn set(
    handle: *mut c_void,
    scene: Text,
    timeout_ns: u64,
    error: *mut Error,
) -> Status {
    let work = |lighting: &mut Opened| {
        // SAFETY: the host lends the text for the call.
        let scene = unsafe { memory::text("scene", scene) }?;
        Ok(lighting.set(scene, deadline(timeout_ns))?)
    };
    // SAFETY: the host guarantees that `error` is valid.
    unsafe { call(handle, error, work) }
}
