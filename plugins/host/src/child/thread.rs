//! How a child runs code of a driver: on threads of its own, and a panic is a failure.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

use taceva_core::ErrorKind;

use super::wire::Failure;

/// What a thread of a C program has, in bytes: libraries of linear algebra take more of it than the 2 MiB of Rust.
const STACK: usize = 8 << 20;

/// Starts a thread.
pub(super) fn start(name: &str, run: impl FnOnce() + Send + 'static) -> Result<(), Failure> {
    std::thread::Builder::new()
        .name(name.to_owned())
        .stack_size(STACK)
        .spawn(run)
        .map(drop)
        .map_err(|error| Failure::new(ErrorKind::Internal, "start a thread", &error.to_string()))
}

/// Runs code of a driver; a panic is a failure that says what it said.
pub(super) fn guarded<T>(doing: &str, run: impl FnOnce() -> T) -> Result<T, Failure> {
    // Whoever panicked is not called again.
    catch_unwind(AssertUnwindSafe(run)).map_err(|payload| {
        let said = said(&*payload);
        // Dropping what it panicked with might panic again.
        std::mem::forget(payload);
        Failure::new(ErrorKind::Panicked, doing, &said)
    })
}

fn said(payload: &(dyn Any + Send)) -> String {
    let text = payload
        .downcast_ref::<&str>()
        .copied()
        .or_else(|| payload.downcast_ref::<String>().map(String::as_str));
    match text {
        Some(text) => format!("the driver panicked: {text}"),
        None => "the driver panicked".to_owned(),
    }
}
