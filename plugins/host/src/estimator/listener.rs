//! Progress of a fit, from the library to the caller.

#![expect(unsafe_code, reason = "a function that the library calls")]

use std::ffi::c_void;

use taceva_core::{Progress, caught, whole_count};

/// Number of progress steps of a fit.
pub(super) const STEPS: u64 = 1_000;

pub(super) struct Listener<'a> {
    pub(super) progress: &'a dyn Progress,
    pub(super) reported: u64,
}

/// Reports the fraction `done` of a fit. Returns 1 if the fit is cancelled.
pub(super) unsafe extern "C" fn progress(context: *mut c_void, done: f64) -> i32 {
    // SAFETY: `context` is the listener that `fit` passed for the pending call.
    let listener = unsafe { &mut *context.cast::<Listener<'_>>() };
    let reached = whole_count(done.clamp(0.0, 1.0) * STEPS as f64);
    let reported = listener.reported;
    listener.reported = reported.max(reached);
    let progress = listener.progress;
    // A panic of the listener must not unwind into the library. It cancels the fit instead.
    let cancelled = caught(|| {
        if reached > reported {
            progress.advance(reached - reported);
        }
        progress.is_cancelled()
    });
    i32::from(cancelled.unwrap_or(true))
}
