//! Rigs: objects that several devices share, and the simulated bench of a plugin with a bench.

#![expect(unsafe_code, reason = "functions that a host calls")]

use std::ffi::c_void;
use std::ptr::null;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use taceva_abi::ext::{BENCH, BenchCalls, Specimen as AbiSpecimen};
use taceva_abi::{Error, Rig as AbiRig, Status, TakeText, Text};
use taceva_core::{ErrorKind, GratingKind, Nanometre, Rig, SimulatedBench, Specimen};

use crate::driver_lists::loaded;
use crate::failure::Failure;
use crate::guard::{caught, guard};
use crate::{handles, memory};

type Shared = Mutex<Rig>;

pub(crate) unsafe extern "C" fn open(rig: *mut *mut AbiRig, error: *mut Error) -> Status {
    let work = || {
        // SAFETY: the host provides memory for the rig.
        let place = unsafe { memory::place("rig", rig) }?;
        *place = handles::keep(Shared::new(Rig::new())).cast();
        Ok(())
    };
    // SAFETY: the host guarantees that `error` is valid.
    unsafe { guard(error, work) }
}

pub(crate) unsafe extern "C" fn close(rig: *mut AbiRig) {
    handles::close(rig.cast());
}

pub(crate) unsafe extern "C" fn extension(_: *mut AbiRig, id: Text) -> *const c_void {
    // SAFETY: the host lends the text for the call.
    let id = caught(|| unsafe { memory::text("id", id) });
    match id {
        Ok(Ok(BENCH)) => std::ptr::from_ref(&CALLS).cast(),
        _ => null(),
    }
}

/// Runs `work` with the rig of the handle `rig`.
pub(crate) fn with_rig<R>(
    rig: *const AbiRig,
    work: impl FnOnce(&mut Rig) -> R,
) -> Result<R, Failure> {
    let shared = handles::find::<Shared>(rig.cast())?;
    // The rig is intact after a panic of a driver, because shared objects are inserted in one step.
    let mut rig = shared.lock().unwrap_or_else(PoisonError::into_inner);
    Ok(work(&mut rig))
}

static CALLS: BenchCalls = BenchCalls {
    #[expect(clippy::cast_possible_truncation, reason = "sixty bytes")]
    size: size_of::<BenchCalls>() as u32,
    reserved: 0,
    now_ns: Some(now_ns),
    rest: Some(rest),
    mount: Some(mount),
    name_press: Some(name_press),
    schedule: Some(schedule),
    provenance: Some(provenance),
};

/// Finds the simulated bench of the devices that were opened with the argument `rig=NAME`. Drivers register a bench under the prefix of their keys.
unsafe fn bench(rig: *const AbiRig, name: Text) -> Result<Arc<dyn SimulatedBench>, Failure> {
    // SAFETY: the host lends the text for the call.
    let name = unsafe { memory::text("bench", name) }?;
    let prefixes = &loaded()?.prefixes;
    let find = |rig: &mut Rig| {
        let mut names = prefixes.iter().map(|prefix| format!("{prefix} {name}"));
        names.find_map(|name| rig.bench(&name))
    };
    with_rig(rig, find)?.ok_or_else(|| {
        Failure::new(
            ErrorKind::NotFound,
            format!("no bench has the name `{name}`"),
        )
    })
}

unsafe extern "C" fn now_ns(rig: *mut AbiRig, name: Text) -> u64 {
    // SAFETY: the host lends the text for the call.
    let now = caught(|| unsafe { bench(rig, name) }.map(|bench| bench.now()));
    // The time of a missing bench is 0.
    let now = now.unwrap_or_else(Err).unwrap_or_default();
    u64::try_from(now.as_nanos()).unwrap_or(u64::MAX)
}

unsafe extern "C" fn rest(rig: *mut AbiRig, name: Text, rest_ns: u64, error: *mut Error) -> Status {
    // SAFETY: the host lends the text for the call and guarantees that `error` is valid.
    unsafe {
        guard(error, || {
            Ok(bench(rig, name)?.rest(Duration::from_nanos(rest_ns))?)
        })
    }
}

unsafe extern "C" fn mount(
    rig: *mut AbiRig,
    name: Text,
    mounted: *const AbiSpecimen,
    error: *mut Error,
) -> Status {
    let work = || {
        // SAFETY: the host lends both for the call.
        let (bench, mounted) = unsafe { (bench(rig, name)?, memory::sized("specimen", mounted)?) };
        Ok(bench.mount(specimen(mounted)?)?)
    };
    // SAFETY: the host guarantees that `error` is valid.
    unsafe { guard(error, work) }
}

fn specimen(abi: &AbiSpecimen) -> Result<Specimen, Failure> {
    let size = Nanometre(abi.size_nm);
    let grating = |kind| Specimen::Grating {
        kind,
        spacing: size,
    };
    match abi.kind {
        AbiSpecimen::SPHERE => Ok(Specimen::Sphere { radius: size }),
        AbiSpecimen::LINE => Ok(grating(GratingKind::Line)),
        AbiSpecimen::DOT => Ok(grating(GratingKind::Dot)),
        other => Err(Failure::argument(format!(
            "the specimen has the unknown kind {other}"
        ))),
    }
}

unsafe extern "C" fn name_press(
    rig: *mut AbiRig,
    name: Text,
    press: u64,
    error: *mut Error,
) -> Status {
    // SAFETY: the host lends the text for the call and guarantees that `error` is valid.
    unsafe { guard(error, || Ok(bench(rig, name)?.name_press(press)?)) }
}

unsafe extern "C" fn schedule(
    rig: *mut AbiRig,
    name: Text,
    at_ns: u64,
    error: *mut Error,
) -> Status {
    // SAFETY: the host lends the text for the call and guarantees that `error` is valid.
    unsafe {
        guard(error, || {
            Ok(bench(rig, name)?.schedule(Duration::from_nanos(at_ns))?)
        })
    }
}

unsafe extern "C" fn provenance(
    rig: *mut AbiRig,
    name: Text,
    take: TakeText,
    context: *mut c_void,
    error: *mut Error,
) -> Status {
    let work = || {
        // SAFETY: the host lends the text for the call.
        match unsafe { bench(rig, name) }?.provenance() {
            // SAFETY: the host passes its own function and context.
            Some(words) => unsafe { memory::hand(take, context, &words) },
            None => Ok(()),
        }
    };
    // SAFETY: the host guarantees that `error` is valid.
    unsafe { guard(error, work) }
}
