//! Functions with which the host calls a force transducer.

#![expect(unsafe_code, reason = "functions that a host calls")]

use std::ffi::c_void;

use taceva_abi::ext::{NUMBERED, NumberedCalls, TARE, TareCalls};
use taceva_abi::{Error, ForceCalls, Stamp, Status, Text, Wrench};
use taceva_core::{ErrorKind, Facts, ForceTransducer};

use super::{Kind, call, device_calls, extended};
use crate::convert::{self, deadline};
use crate::driver_lists::{Drivers, Loaded};
use crate::failure::Failure;
use crate::handles::Handle;
use crate::memory;

/// Open force transducer, with a flag that is true if its driver declares numbered readings.
pub(crate) struct Opened {
    force: Box<dyn ForceTransducer>,
    is_numbered: bool,
}

impl Kind for dyn ForceTransducer {
    type Opened = Opened;
    type Calls = ForceCalls;
    const CALLS: &'static ForceCalls = &CALLS;

    fn drivers(loaded: &Loaded) -> &Drivers<dyn ForceTransducer> {
        &loaded.forces
    }

    fn handle(force: Box<dyn ForceTransducer>, facts: &Facts) -> Handle<Opened> {
        let interrupt = force.interrupt_handle();
        let is_numbered = matches!(facts, Facts::Force(facts) if facts.numbered);
        Handle::new(Opened { force, is_numbered }).interrupted_by(interrupt)
    }
}

static CALLS: ForceCalls = ForceCalls {
    device: device_calls::<ForceCalls, Opened>(extension),
    start: Some(start),
    read: Some(read),
    stop: Some(stop),
    lost: Some(lost),
};

static TARE_CALLS: TareCalls = TareCalls {
    #[expect(clippy::cast_possible_truncation, reason = "sixteen bytes")]
    size: size_of::<TareCalls>() as u32,
    reserved: 0,
    zero: Some(zero),
};

static NUMBERED_CALLS: NumberedCalls = NumberedCalls {
    #[expect(clippy::cast_possible_truncation, reason = "sixteen bytes")]
    size: size_of::<NumberedCalls>() as u32,
    reserved: 0,
    sequence: Some(sequence),
};

unsafe extern "C" fn extension(handle: *mut c_void, id: Text) -> *const c_void {
    let tares = |opened: &mut Opened| opened.force.tare().is_some();
    let numbers = |opened: &mut Opened| opened.is_numbered;
    // SAFETY: the host lends the text for the call.
    let tare = unsafe { extended(handle, id, TARE, &TARE_CALLS, tares) };
    if !tare.is_null() {
        return tare;
    }
    // SAFETY: as above.
    unsafe { extended(handle, id, NUMBERED, &NUMBERED_CALLS, numbers) }
}

unsafe extern "C" fn start(handle: *mut c_void, timeout_ns: u64, error: *mut Error) -> Status {
    let work = |opened: &mut Opened| Ok(opened.force.start(deadline(timeout_ns))?);
    // SAFETY: the host guarantees that `error` is valid.
    unsafe { call(handle, error, work) }
}

unsafe extern "C" fn stop(handle: *mut c_void, error: *mut Error) -> Status {
    // SAFETY: the host guarantees that `error` is valid.
    unsafe {
        call(handle, error, |opened: &mut Opened| {
            Ok(opened.force.stop()?)
        })
    }
}

unsafe extern "C" fn lost(handle: *mut c_void, lost: *mut u64, error: *mut Error) -> Status {
    let work = |opened: &mut Opened| {
        // SAFETY: the host provides memory for the number.
        let place = unsafe { memory::place("lost", lost) }?;
        let none = || Failure::new(ErrorKind::NotFound, "the driver counts no lost readings");
        *place = opened.force.lost().ok_or_else(none)?;
        Ok(())
    };
    // SAFETY: the host guarantees that `error` is valid.
    unsafe { call(handle, error, work) }
}

unsafe extern "C" fn read(
    handle: *mut c_void,
    wrench: *mut Wrench,
    stamp: *mut Stamp,
    timeout_ns: u64,
    error: *mut Error,
) -> Status {
    let work = |opened: &mut Opened| {
        // SAFETY: the host provides memory for both.
        let (wrench, stamp) = unsafe {
            (
                memory::place("wrench", wrench)?,
                memory::place("stamp", stamp)?,
            )
        };
        let (read, at) = opened.force.read(deadline(timeout_ns))?;
        (*wrench, *stamp) = (convert::wrench(&read)?, convert::stamp(&at)?);
        Ok(())
    };
    // SAFETY: the host guarantees that `error` is valid.
    unsafe { call(handle, error, work) }
}

unsafe extern "C" fn zero(handle: *mut c_void, timeout_ns: u64, error: *mut Error) -> Status {
    let work = |opened: &mut Opened| {
        let tare = opened.force.tare().ok_or_else(|| {
            Failure::new(
                ErrorKind::Unsupported,
                "the transducer does not support taring",
            )
        })?;
        Ok(tare.zero(deadline(timeout_ns))?)
    };
    // SAFETY: the host guarantees that `error` is valid.
    unsafe { call(handle, error, work) }
}

unsafe extern "C" fn sequence(
    handle: *mut c_void,
    sequence: *mut u64,
    error: *mut Error,
) -> Status {
    let work = |opened: &mut Opened| {
        // SAFETY: the host provides memory for the number.
        let place = unsafe { memory::place("sequence", sequence) }?;
        let none = || Failure::new(ErrorKind::NotFound, "no numbered reading yet");
        *place = opened.force.sequence().ok_or_else(none)?;
        Ok(())
    };
    // SAFETY: the host guarantees that `error` is valid.
    unsafe { call(handle, error, work) }
}
