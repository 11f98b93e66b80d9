//! Log and clock of the host, for drivers in a plugin.

#![expect(unsafe_code, reason = "functions of the host are called")]

use std::ptr::null_mut;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicPtr, Ordering};
use std::time::{Duration, Instant};

use taceva_abi::{Host, Level, Text};

/// Functions of the host, set between `init` and `deinit`; otherwise NULL.
static HOST: AtomicPtr<Host> = AtomicPtr::new(null_mut());

/// Stores the functions of the host, for [`log`] and [`now`].
pub(crate) fn remember(host: *const Host) {
    HOST.store(host.cast_mut(), Ordering::Release);
}

/// Forgets the functions of the host. Later log lines are dropped, and [`now`] uses the clock of the plugin.
pub(crate) fn forget() {
    HOST.store(null_mut(), Ordering::Release);
}

fn host() -> Option<&'static Host> {
    let host = HOST.load(Ordering::Acquire);
    // SAFETY: `init` checked the pointer. A host outlives all objects of the plugin until `deinit`, which forgets it.
    unsafe { host.as_ref() }
}

/// Writes a line to the log of the host. Does nothing if the driver is linked into the program and is not loaded as a plugin.
///
/// ```
/// taceva_plugin::log(taceva_plugin::Level::Warn, "the camera is warm");
/// ```
pub fn log(level: Level, message: &str) {
    let Some((host, log)) = host().and_then(|host| Some((host, host.log?))) else {
        return;
    };
    let target = Text::from(env!("CARGO_PKG_NAME"));
    // SAFETY: the host accepts lines from any thread, and both texts live for the call.
    unsafe { log(host.context, level as i32, target, Text::from(message)) };
}

/// Time of the monotonic clock of the host, for the stamps of real devices.
///
/// If the driver is linked into a program, or before the plugin is initialised, the time counts from the first call of this function.
///
/// ```
/// let before = taceva_plugin::now();
/// assert!(taceva_plugin::now() >= before);
/// ```
pub fn now() -> Duration {
    static FIRST: OnceLock<Instant> = OnceLock::new();
    match host().and_then(|host| Some((host, host.now_ns?))) {
        // SAFETY: the host allows this call from any thread.
        Some((host, now_ns)) => Duration::from_nanos(unsafe { now_ns(host.context) }),
        None => FIRST.get_or_init(Instant::now).elapsed(),
    }
}
