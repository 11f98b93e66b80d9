//! What a plugin may ask of us: a line for the log, and the time.

#![expect(unsafe_code, reason = "functions that a plugin calls")]

use std::ffi::c_void;

use rustix::time::{ClockId, clock_gettime};
use taceva_abi as abi;
use taceva_core::caught;

use crate::text::shown;

/// How much a line of a plugin's log matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// Something failed.
    Error,
    /// Something is odd.
    Warn,
    /// Something happened.
    Info,
    /// For whoever looks for a fault.
    Debug,
}

/// Takes the lines that a plugin logs: how much they matter, what they are about, and what they say.
pub type Log = Box<dyn Fn(Level, &str, &str) + Send + Sync>;

/// The table that a plugin is initialised with; it is there for good, as the library is.
pub(super) fn table(log: Log) -> *const abi::Host {
    let log: &'static Log = Box::leak(Box::new(log));
    let host = abi::Host {
        size: u32::try_from(size_of::<abi::Host>()).expect("a small table"),
        abi_minor: abi::ABI_MINOR,
        context: std::ptr::from_ref(log).cast_mut().cast(),
        log: Some(write),
        now_ns: Some(now),
    };
    std::ptr::from_ref(Box::leak(Box::new(host)))
}

/// Longest line or target, in bytes: a length that nobody means is not read.
const LENGTH_MAX: usize = 1 << 16;

unsafe extern "C" fn write(
    context: *mut c_void,
    level: i32,
    target: abi::Text,
    message: abi::Text,
) {
    let read = |text: abi::Text| {
        let is_text = text.length <= LENGTH_MAX;
        // SAFETY: borrowed for this call by the rule of the interface, and its length is bounded.
        let text = is_text.then(|| unsafe { text.to_str() });
        match text {
            Some(Ok(text)) => shown(text),
            _ => "(no text)".to_owned(),
        }
    };
    let level = match level {
        1 => Level::Error,
        2 => Level::Warn,
        3 => Level::Info,
        _ => Level::Debug,
    };
    if context.is_null() {
        return;
    }
    // SAFETY: `context` is the log that `table` leaked, as this function and it are only handed over together.
    let log = unsafe { &*context.cast::<Log>() };
    // A panic must not unwind into the library; only this line of the log is lost then.
    let _ = caught(|| log(level, &read(target), &read(message)));
}

unsafe extern "C" fn now(_: *mut c_void) -> u64 {
    let time = clock_gettime(ClockId::Monotonic);
    let seconds = u64::try_from(time.tv_sec).unwrap_or(0);
    let nanoseconds = u64::try_from(time.tv_nsec).unwrap_or(0);
    seconds
        .saturating_mul(1_000_000_000)
        .saturating_add(nanoseconds)
}
