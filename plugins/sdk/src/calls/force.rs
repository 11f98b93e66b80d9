//! The calls on a force transducer.

#![expect(unsafe_code, reason = "functions that a host calls")]

use std::ffi::c_void;

use taceva_abi::ext::{TARE, TareCalls};
use taceva_abi::{Error, ForceCalls, Stamp, Status, Text, Wrench};
use taceva_core::{ErrorKind, Facts, ForceTransducer};

use super::{Kind, call, device_calls, extended};
use crate::convert::{self, deadline};
use crate::failure::Failure;
use crate::loaded::{Drivers, Loaded};
use crate::memory;
use crate::open::Handle;

type Opened = Box<dyn ForceTransducer>;

impl Kind for dyn ForceTransducer {
    type Opened = Opened;
    type Calls = ForceCalls;
    const CALLS: &'static ForceCalls = &CALLS;

    fn drivers(loaded: &Loaded) -> &Drivers<dyn ForceTransducer> {
        &loaded.forces
    }

    fn handle(device: Box<dyn ForceTransducer>, _: &Facts) -> Handle<Opened> {
        let interrupt = device.interrupt_handle();
        Handle::new(device).interrupted_by(interrupt)
    }
}

static CALLS: ForceCalls = ForceCalls {
    device: device_calls::<ForceCalls, Opened>(extension),
    start: Some(start),
    read: Some(read),
    stop: Some(stop),
};

static TARE_CALLS: TareCalls = TareCalls {
    #[expect(clippy::cast_possible_truncation, reason = "sixteen bytes")]
    size: size_of::<TareCalls>() as u32,
    reserved: 0,
    zero: Some(zero),
};

unsafe extern "C" fn extension(handle: *mut c_void, id: Text) -> *const c_void {
    let has = |force: &mut Opened| force.tare().is_some();
    // SAFETY: the host lends the text for the call.
    unsafe { extended(handle, id, (TARE, &TARE_CALLS), has) }
}

unsafe extern "C" fn start(handle: *mut c_void, timeout_ns: u64, error: *mut Error) -> Status {
    let work = |force: &mut Opened| Ok(force.start(deadline(timeout_ns))?);
    // SAFETY: the host's own promise for `error`.
    unsafe { call(handle, error, work) }
}

unsafe extern "C" fn stop(handle: *mut c_void, error: *mut Error) -> Status {
    // SAFETY: the host's own promise for `error`.
    unsafe { call(handle, error, |force: &mut Opened| Ok(force.stop()?)) }
}

unsafe extern "C" fn read(
    handle: *mut c_void,
    wrench: *mut Wrench,
    stamp: *mut Stamp,
    timeout_ns: u64,
    error: *mut Error,
) -> Status {
    let work = |force: &mut Opened| {
        // SAFETY: the host's places for the two.
        let (wrench, stamp) = unsafe {
            (
                memory::place("wrench", wrench)?,
                memory::place("stamp", stamp)?,
            )
        };
        let (read, at) = force.read(deadline(timeout_ns))?;
        (*wrench, *stamp) = (convert::wrench(&read)?, convert::stamp(&at)?);
        Ok(())
    };
    // SAFETY: the host's own promise for `error`.
    unsafe { call(handle, error, work) }
}

unsafe extern "C" fn zero(handle: *mut c_void, timeout_ns: u64, error: *mut Error) -> Status {
    let work = |force: &mut Opened| {
        let tare = force.tare().ok_or_else(|| {
            Failure::new(
                ErrorKind::Unsupported,
                "the transducer cannot call a load zero",
            )
        })?;
        Ok(tare.zero(deadline(timeout_ns))?)
    };
    // SAFETY: the host's own promise for `error`.
    unsafe { call(handle, error, work) }
}
