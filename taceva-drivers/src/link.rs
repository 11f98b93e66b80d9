//! Shared parts of drivers: connections with a timeout, link errors, a mailbox for the newest reading, and the clock for stamps.

#[cfg(feature = "tcp")]
mod connect;
#[cfg(any(feature = "ur", feature = "xarm"))]
pub(crate) mod course;
#[cfg(feature = "tcp")]
mod error;
pub(crate) mod mailbox;
#[cfg(any(feature = "ur", feature = "xarm"))]
pub(crate) mod watch;

#[cfg(feature = "tcp")]
pub(crate) use connect::connect;
#[cfg(feature = "tcp")]
pub(crate) use error::LinkError;
pub(crate) use mailbox::Mailbox;
#[cfg(any(
    feature = "camera",
    feature = "gcode",
    feature = "netft",
    feature = "sri",
    feature = "ur",
    feature = "xarm"
))]
pub(crate) use mailbox::Seen;

/// Parses hexadecimal bytes separated by white space.
#[cfg(all(
    test,
    any(feature = "netft", feature = "sri", feature = "ur", feature = "xarm")
))]
pub(crate) fn hexadecimal(text: &str) -> Vec<u8> {
    let digits: Vec<u32> = text
        .chars()
        .filter_map(|digit| digit.to_digit(16))
        .collect();
    let byte = |pair: &[u32]| u8::try_from(16 * pair[0] + pair[1]).expect("two digits");
    digits.chunks_exact(2).map(byte).collect()
}

/// Current time of the clock that stamps the readings of real devices.
pub(crate) fn monotonic() -> std::time::Duration {
    crate::clock::MonotonicClock.now()
}
