//! Guard of every function that a host calls. Converts panics and failures to a status, so that no panic unwinds into the host.

#![expect(unsafe_code, reason = "the caller's memory for the message is written")]

use std::mem::offset_of;

use taceva_abi::{Error, FaultNumber, MESSAGE_SIZE, Status};
use taceva_core::ErrorKind;

use crate::failure::Failure;

/// Runs `work` and returns its status. A panic becomes a failure. Writes the message of a failure to `error`.
///
/// # Safety
/// `error` is NULL, or points to as many bytes as its field `size` states. No other code uses these bytes during the call.
pub(crate) unsafe fn guard(
    error: *mut Error,
    work: impl FnOnce() -> Result<(), Failure>,
) -> Status {
    let failure = match caught(work) {
        Ok(Ok(())) => return Status::OK,
        Ok(Err(failure)) => failure,
        Err(panicked) => panicked,
    };
    // SAFETY: guaranteed by the caller.
    unsafe {
        write_message(error, &failure.message);
        write_fault(error, failure.fault);
    }
    failure.status
}

/// Runs `work` and returns its result. A panic becomes a failure.
pub(crate) fn caught<T>(work: impl FnOnce() -> T) -> Result<T, Failure> {
    // A panic can leave only one handle half changed, and that handle is dead from then on.
    taceva_core::caught(work).map_err(|message| {
        Failure::new(
            ErrorKind::Panicked,
            format!("the plugin panicked: {message}"),
        )
    })
}

/// Writes `message` to the `error` of the caller. Truncates a message that is too long, between two characters.
unsafe fn write_message(error: *mut Error, message: &str) {
    const HEAD: usize = offset_of!(Error, message);
    if error.is_null() || !error.is_aligned() {
        return;
    }
    // SAFETY: guaranteed by the caller of `guard`; every error begins with its size.
    let size = unsafe { (&raw const (*error).size).read() };
    let room = usize::try_from(size).unwrap_or(0).min(size_of::<Error>());
    if room <= HEAD {
        return;
    }
    let mut end = message.len().min((room - HEAD).min(MESSAGE_SIZE) - 1);
    while !message.is_char_boundary(end) {
        end -= 1;
    }
    // SAFETY: `end` and the NUL after it lie within the stated size of the error.
    unsafe {
        let place = (&raw mut (*error).message).cast::<u8>();
        place.copy_from_nonoverlapping(message.as_ptr(), end);
        place.add(end).write(0);
    }
}

/// Writes `fault` to the `error` of the caller, if the `size` of the error is large enough for this field.
unsafe fn write_fault(error: *mut Error, fault: FaultNumber) {
    const END: usize = offset_of!(Error, fault) + size_of::<FaultNumber>();
    if error.is_null() || !error.is_aligned() {
        return;
    }
    // SAFETY: guaranteed by the caller of `guard`; every error begins with its size.
    let size = unsafe { (&raw const (*error).size).read() };
    if usize::try_from(size).is_ok_and(|size| size >= END) {
        // SAFETY: the field lies within the stated size of the error.
        unsafe { (&raw mut (*error).fault).write(fault) };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(error: &Error) -> String {
        String::from_utf8(error.bytes().collect()).expect("UTF-8")
    }

    #[test]
    fn a_panic_ends_in_a_status_and_its_words() {
        let mut error = Error::new();
        let panics: [(fn(), &str); 3] = [
            (|| panic!("plain"), "plain"),
            (|| panic!("{} of {}", 1, 2), "1 of 2"),
            (|| std::panic::panic_any(()), "a panic without a message"),
        ];
        for (panics, expected) in panics {
            // SAFETY: the error belongs to this test.
            let status = unsafe {
                guard(&raw mut error, || {
                    panics();
                    Ok(())
                })
            };
            assert_eq!(status, Status::PANICKED);
            assert_eq!(message(&error), format!("the plugin panicked: {expected}"));
        }
    }

    #[test]
    fn a_payload_that_panics_when_dropped_is_never_dropped() {
        struct Bomb;
        impl Drop for Bomb {
            fn drop(&mut self) {
                panic!("dropped");
            }
        }
        // SAFETY: NULL stands for no error.
        let status = unsafe { guard(std::ptr::null_mut(), || std::panic::panic_any(Bomb)) };
        assert_eq!(status, Status::PANICKED);
    }

    #[test]
    fn no_message_is_written_further_than_the_size_says() {
        for size in [0_u32, 4, 8, 9, 10, 12, 511, 512, 516, 4096] {
            let mut error = Error::new();
            error.message.fill(1);
            error.size = size;
            let long = "é".repeat(400);
            // SAFETY: the error belongs to this test. Its stated size exceeds the real one only in the last case, which is limited.
            unsafe { guard(&raw mut error, || Err(Failure::argument(long))) };
            let written = error.message.iter().take_while(|byte| **byte != 1).count();
            let room = usize::try_from(size).expect("small").clamp(8, 512) - 8;
            assert!(written <= room, "{size}: {written}");
            assert!(room < 3 || written + 1 >= room, "{size}: {written}");
        }
    }

    #[test]
    fn a_fault_is_written_where_the_error_has_room_for_it_and_nowhere_else() {
        for (size, expected) in [(512, FaultNumber::NONE), (516, FaultNumber::COLLISION)] {
            let mut error = Error::new();
            error.size = size;
            let arm = taceva_core::DriverKey::fixed("org.example.arm/arm");
            let struck = taceva_core::DriverError::new(ErrorKind::DeviceFault, &arm, "move")
                .with_fault(taceva_core::Fault::Collision);
            // SAFETY: the error belongs to this test and has its stated size.
            let status = unsafe { guard(&raw mut error, || Err(struck.into())) };
            assert_eq!((status, error.fault), (Status::DEVICE_FAULT, expected));
        }
    }
}
