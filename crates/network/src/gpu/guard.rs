//! The one place where panics of foreign code are caught: burn and the libraries below it report a failed device in no other way.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
#[cfg(feature = "cuda")]
use std::sync::{Mutex, PoisonError};

use crate::NetworkError;

/// What `work` gives, or why the device could not do it.
pub(crate) fn guard<T>(
    gpu: &str,
    work: impl FnOnce() -> Result<T, NetworkError>,
) -> Result<T, NetworkError> {
    contained(work).unwrap_or_else(|problem| {
        Err(NetworkError::Device {
            device: gpu.to_owned(),
            problem,
        })
    })
}

/// What `work` gives, or what it panicked with.
pub(crate) fn contained<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    // What was half done is of no use: an engine whose step failed makes no other.
    catch_unwind(AssertUnwindSafe(work)).map_err(message)
}

/// As [`contained`], and the panic is not written to the terminal, since it says what is expected.
#[cfg(feature = "cuda")]
pub(crate) fn contained_quietly<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    // One at a time: of two, the second would take the silence of the first for what stood there, and leave it for good.
    static QUIET: Mutex<()> = Mutex::new(());
    let _alone = QUIET.lock().unwrap_or_else(PoisonError::into_inner);
    let hook = std::panic::take_hook();
    std::panic::set_hook(Box::new(|_| {}));
    let result = contained(work);
    std::panic::set_hook(hook);
    result
}

fn message(panic: Box<dyn Any + Send>) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
    text.unwrap_or("it stopped without a reason").to_owned()
}
