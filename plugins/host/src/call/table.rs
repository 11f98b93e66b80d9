//! Copies function tables of a plugin library. The smaller of the sizes that library and host state limits the copy.

#![expect(
    unsafe_code,
    reason = "tables are read at addresses that a library states"
)]

use std::ffi::c_void;
use std::mem::MaybeUninit;

use taceva_abi as abi;
use taceva_core::ErrorKind;

use super::Failure;

/// Table of functions whose first field is its size.
///
/// # Safety
/// The type is `repr(C)`, begins with its size as a `u32`, and has a valid value whose bytes are all 0.
pub unsafe trait Table: Copy {
    /// Name of the table, for messages.
    const NAME: &'static str;
}

macro_rules! tables {
    ($($table:ty => $name:literal),* $(,)?) => {$(
        // SAFETY: it is `repr(C)`, begins with `size: u32`, and holds only numbers and optional functions.
        unsafe impl Table for $table {
            const NAME: &'static str = $name;
        }
    )*};
}

tables! {
    abi::Factory => "taceva_factory",
    abi::EstimatorFactory => "taceva_estimator_factory",
    abi::SensorCalls => "taceva_sensor_calls",
    abi::RobotCalls => "taceva_robot_calls",
    abi::ForceCalls => "taceva_force_calls",
    abi::LightingCalls => "taceva_lighting_calls",
    abi::ChangerCalls => "taceva_changer_calls",
    abi::RegressorCalls => "taceva_regressor_calls",
    abi::ext::TareCalls => "taceva_tare_calls",
    abi::ext::NumberedCalls => "taceva_numbered_calls",
    abi::ext::GuardedMotionCalls => "taceva_guarded_motion_calls",
    abi::ext::ExpiringMotionCalls => "taceva_expiring_motion_calls",
    abi::ext::SensorLightingCalls => "taceva_sensor_lighting_calls",
    abi::ext::BenchCalls => "taceva_bench_calls",
}

/// Copies the function table at `table`. Fields beyond the size that the plugin states are NULL.
///
/// # Safety
/// `table` points to a table of the interface: its size field can be read, and so can as many bytes as this field states.
pub(crate) unsafe fn table<T: Table>(table: *const c_void) -> Result<T, Failure> {
    let refused = |problem: &str| Failure::new(ErrorKind::Abi, format!("{}: {problem}", T::NAME));
    if table.is_null() {
        return Err(refused("the table is NULL"));
    }
    if !table.addr().is_multiple_of(align_of::<T>()) {
        return Err(refused("the table is misaligned"));
    }
    // SAFETY: not NULL, aligned, and begins with its size, as the caller guarantees.
    let size = unsafe { table.cast::<u32>().read() };
    let size = usize::try_from(size).unwrap_or(usize::MAX);
    if size < size_of::<u64>() {
        return Err(refused("the size is below 8 bytes"));
    }
    let mut copy = MaybeUninit::<T>::zeroed();
    let known = size.min(size_of::<T>());
    // SAFETY: `known` bytes can be read from the plugin's table and written to ours, because both have at least as many.
    unsafe {
        std::ptr::copy_nonoverlapping(table.cast::<u8>(), copy.as_mut_ptr().cast::<u8>(), known);
    }
    // SAFETY: the bytes that were not copied are 0, which is valid for every `Table`.
    Ok(unsafe { copy.assume_init() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shorter_table_ends_in_functions_that_are_absent() {
        let mut calls: abi::ForceCalls = {
            // SAFETY: all bytes 0 is a table without functions.
            unsafe { MaybeUninit::zeroed().assume_init() }
        };
        unsafe extern "C" fn close(_: *mut c_void) {}
        calls.device.close = Some(close);
        let copy = |size: u32, calls: &mut abi::ForceCalls| {
            calls.device.size = size;
            // SAFETY: it is a table whose stated size does not exceed its real size.
            unsafe { table::<abi::ForceCalls>(std::ptr::from_ref(calls).cast()) }
        };
        assert!(copy(16, &mut calls).expect("read").device.close.is_some());
        assert!(copy(8, &mut calls).expect("read").device.close.is_none());
        assert!(copy(4, &mut calls).is_err());
        // SAFETY: NULL and misaligned tables are rejected unread.
        assert!(unsafe { table::<abi::ForceCalls>(std::ptr::null()) }.is_err());
        let odd = std::ptr::from_ref(&calls).cast::<u8>().wrapping_add(1);
        // SAFETY: as above.
        assert!(unsafe { table::<abi::ForceCalls>(odd.cast()) }.is_err());
    }
}
