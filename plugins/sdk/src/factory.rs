//! Functions with which the host describes, discovers and opens drivers of one kind.

#![expect(unsafe_code, reason = "functions that a host calls")]

use std::ffi::c_void;

use taceva_abi::{
    Args as AbiArgs, Device, Error, Factory as Table, Rig as AbiRig, Status, TakeText,
};
use taceva_core::{ArgSpec, Args, Factory, Presence, Rig};

use crate::calls::Kind;
use crate::driver_lists::loaded;
use crate::failure::Failure;
use crate::guard::guard;
use crate::handles;
use crate::memory;
use crate::rig::with_rig;
use crate::table::provides_table;

/// Table of functions of a plugin with `drivers` drivers of the kind `D`.
pub(crate) fn table<D: Kind + ?Sized>(drivers: u32) -> Table {
    #[expect(clippy::cast_possible_truncation, reason = "forty bytes")]
    let size = size_of::<Table>() as u32;
    Table {
        size,
        drivers,
        describe: Some(describe::<D>),
        discover: Some(discover::<D>),
        open: Some(open::<D>),
    }
}

fn driver<D: Kind + ?Sized>(number: u32) -> Result<&'static dyn Factory<D>, Failure> {
    let drivers = D::drivers(loaded()?);
    let found = usize::try_from(number)
        .ok()
        .and_then(|number| drivers.get(number));
    let found = found.ok_or_else(|| {
        Failure::argument(format!(
            "no driver has the number {number}, expected less than {}",
            drivers.len()
        ))
    })?;
    Ok(&**found)
}

unsafe extern "C" fn describe<D: Kind + ?Sized>(
    number: u32,
    given: *const AbiArgs,
    take: TakeText,
    context: *mut c_void,
    error: *mut Error,
) -> Status {
    let work = || {
        let factory = driver::<D>(number)?;
        let specs = factory.descriptor().arguments();
        // SAFETY: the host lends its arguments for the call.
        let descriptor = if unsafe { is_before_any(given, specs) }? {
            factory.descriptor().clone()
        } else {
            // SAFETY: as above.
            let args = unsafe { args(given, specs) }?;
            let described = factory.describe(&args);
            described.map_err(|error| Failure::argument(error.to_string()))?
        };
        // SAFETY: the host passes its own function and context.
        unsafe { memory::hand(take, context, &provides_table(&descriptor)) }
    };
    // SAFETY: the host guarantees that `error` is valid.
    unsafe { guard(error, work) }
}

/// True if the host requests a description without arguments: `given` is NULL, or an argument is required and `given` is empty.
///
/// # Safety
/// `given` is valid, as for [`args`].
unsafe fn is_before_any(given: *const AbiArgs, specs: &[ArgSpec]) -> Result<bool, Failure> {
    if given.is_null() {
        return Ok(true);
    }
    // SAFETY: guaranteed by the caller.
    let given = unsafe { memory::given("args", given) }?;
    let is_required = |spec: &ArgSpec| matches!(spec.presence, Presence::Required);
    Ok(given.count == 0 && specs.iter().any(is_required))
}

unsafe extern "C" fn discover<D: Kind + ?Sized>(
    number: u32,
    take: TakeText,
    context: *mut c_void,
    error: *mut Error,
) -> Status {
    let work = || {
        for found in driver::<D>(number)?.discover()? {
            // SAFETY: the host passes its own function and context.
            unsafe { memory::hand(take, context, &found.arguments) }?;
        }
        Ok(())
    };
    // SAFETY: the host guarantees that `error` is valid.
    unsafe { guard(error, work) }
}

unsafe extern "C" fn open<D: Kind + ?Sized>(
    number: u32,
    given: *const AbiArgs,
    rig: *mut AbiRig,
    device: *mut Device,
    error: *mut Error,
) -> Status {
    let work = || {
        // SAFETY: the host provides memory for the device.
        let place = unsafe { memory::place("device", device) }?;
        let factory = driver::<D>(number)?;
        // SAFETY: the host lends its arguments for the call.
        let args = unsafe { args(given, factory.descriptor().arguments()) }?;
        let opened = if rig.is_null() {
            factory.open(&args, &mut Rig::new())
        } else {
            with_rig(rig, |rig| factory.open(&args, rig))?
        };
        *place = Device {
            handle: handles::keep(D::handle(opened?, factory.descriptor().facts())),
            calls: std::ptr::from_ref(D::CALLS).cast(),
        };
        Ok(())
    };
    // SAFETY: the host guarantees that `error` is valid.
    unsafe { guard(error, work) }
}

/// Reads the arguments `given` by the host, and checks them against their declarations `specs`. NULL is an empty list.
///
/// # Safety
/// `given` is NULL, or points to arguments that stay unchanged during the call.
pub(crate) unsafe fn args(given: *const AbiArgs, specs: &[ArgSpec]) -> Result<Args, Failure> {
    let mut pairs = Vec::new();
    if !given.is_null() {
        // SAFETY: guaranteed by the caller, for the list and for each text in it.
        unsafe {
            let given = memory::given("args", given)?;
            for arg in memory::list("args", given.items, given.count)? {
                pairs.push((
                    memory::text("args", arg.key)?,
                    memory::text("args", arg.text)?,
                ));
            }
        }
    }
    Args::from_pairs(specs, pairs).map_err(|error| Failure::argument(error.to_string()))
}
