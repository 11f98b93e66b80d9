//! How a child runs code of a driver: on threads of its own, and a panic is a failure.

use taceva_core::{ErrorKind, caught};

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
    caught(run).map_err(|message| {
        let message = format!("the driver panicked: {message}");
        Failure::new(ErrorKind::Panicked, doing, &message)
    })
}
