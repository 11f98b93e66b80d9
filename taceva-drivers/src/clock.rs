//! Clock for the time stamps of real devices.

use std::time::Duration;

/// Clock of the machine, which stamps readings of all real devices.
///
/// All processes of a machine share this clock, `CLOCK_MONOTONIC`. On systems other than Unix, time counts from the first use in this process.
///
/// ```
/// use taceva_drivers::MonotonicClock;
/// let before = MonotonicClock.now();
/// assert!(MonotonicClock.now() >= before);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MonotonicClock;

impl MonotonicClock {
    /// Current time since the zero of this clock; never decreases.
    #[cfg(unix)]
    pub fn now(self) -> Duration {
        use rustix::time::{ClockId, clock_gettime};
        // A monotonic clock begins at 0, so neither number is negative.
        Duration::try_from(clock_gettime(ClockId::Monotonic)).unwrap_or_default()
    }

    /// Current time since the zero of this clock; never decreases.
    #[cfg(not(unix))]
    pub fn now(self) -> Duration {
        static BEGAN: std::sync::OnceLock<std::time::Instant> = std::sync::OnceLock::new();
        BEGAN.get_or_init(std::time::Instant::now).elapsed()
    }

    /// Current time in seconds, comparable with a [`Stamp`](taceva_core::Stamp).
    pub fn now_s(self) -> f64 {
        self.now().as_secs_f64()
    }
}

#[cfg(test)]
mod tests {
    use std::time::Instant;

    use super::*;

    #[test]
    fn it_passes_as_the_time_of_the_machine_does() {
        let (began, instant) = (MonotonicClock.now(), Instant::now());
        while instant.elapsed() < Duration::from_millis(3) {
            std::hint::spin_loop();
        }
        let passed = MonotonicClock.now() - began;
        assert!(passed >= Duration::from_millis(3), "{passed:?}");
        assert!(MonotonicClock.now() - began >= passed);
    }
}
