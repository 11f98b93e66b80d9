//! The clock that real devices are stamped by.

use std::time::Duration;

/// The time of the machine: what stamps of real devices count, whoever wrote their driver.
///
/// It is `CLOCK_MONOTONIC`, as for plugins, so that two processes on one machine mean the same by it. Elsewhere than on Unix it counts from
/// the first time that this process asked.
///
/// ```
/// use taceva_drivers::MonotonicClock;
/// let before = MonotonicClock.now();
/// assert!(MonotonicClock.now() >= before);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MonotonicClock;

impl MonotonicClock {
    /// The present; never goes back.
    #[cfg(unix)]
    pub fn now(self) -> Duration {
        use rustix::time::{ClockId, clock_gettime};
        // A monotonic clock begins at 0, so neither number is ever negative.
        Duration::try_from(clock_gettime(ClockId::Monotonic)).unwrap_or_default()
    }

    /// The present; never goes back.
    #[cfg(not(unix))]
    pub fn now(self) -> Duration {
        static BEGAN: std::sync::OnceLock<std::time::Instant> = std::sync::OnceLock::new();
        BEGAN.get_or_init(std::time::Instant::now).elapsed()
    }

    /// The present in s, as stamps write it.
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
