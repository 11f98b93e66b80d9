//! Threads of a child that run driver code. A panic becomes a failure.

use taceva_core::{ErrorKind, caught};

use super::wire::Failure;

/// Stack size of a thread, bytes, as in C programs. Linear-algebra libraries need more than Rust's default of 2 MiB.
const STACK: usize = 8 << 20;

/// Starts a named thread with a stack of [`STACK`] bytes.
pub(super) fn start(name: &str, run: impl FnOnce() + Send + 'static) -> Result<(), Failure> {
    std::thread::Builder::new()
        .name(name.to_owned())
        .stack_size(STACK)
        .spawn(run)
        .map(drop)
        .map_err(|error| Failure::new(ErrorKind::Internal, "start a thread", &error.to_string()))
}

/// Runs driver code. A panic becomes a failure with the panic message.
pub(super) fn guarded<T>(doing: &str, run: impl FnOnce() -> T) -> Result<T, Failure> {
    // After a panic the driver is not called again.
    caught(run).map_err(|message| {
        let message = format!("the driver panicked: {message}");
        Failure::new(ErrorKind::Panicked, doing, &message)
    })
}
