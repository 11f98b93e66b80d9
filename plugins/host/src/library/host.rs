//! Host functions that a plugin may call: logging and clock.

#![expect(unsafe_code, reason = "functions that a plugin calls")]

use std::ffi::c_void;

use rustix::time::{ClockId, clock_gettime};
use taceva_abi as abi;
use taceva_core::caught;

use crate::text::shown;

/// Level of a log line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// A failure.
    Error,
    /// An unexpected condition.
    Warn,
    /// An event.
    Info,
    /// Details for debugging.
    Debug,
}

/// Callback for a plugin's log lines: level, target and message.
pub type Log = Box<dyn Fn(Level, &str, &str) + Send + Sync>;

/// Host table for a plugin's `init`. The table is never freed, because the library is never unloaded.
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

/// Maximum length of a message or target, bytes. Longer texts are not read.
const LENGTH_MAX: usize = 1 << 16;

unsafe extern "C" fn write(
    context: *mut c_void,
    level: i32,
    target: abi::Text,
    message: abi::Text,
) {
    let read = |text: abi::Text| {
        let is_text = text.length <= LENGTH_MAX;
        // SAFETY: the interface lends the text for this call, and its length is bounded.
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
    // SAFETY: `context` is the log that `table` leaked; this function and that pointer are always passed together.
    let log = unsafe { &*context.cast::<Log>() };
    // A panic must not unwind into the library. The log line is then lost.
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
