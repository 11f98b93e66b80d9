//! The clock by which drivers of devices stamp what comes: one for every device of the machine, plugins included.

use std::time::Duration;

/// The time of CLOCK_MONOTONIC, which the plugin boundary counts too; elsewhere the time since the first call.
pub(crate) fn monotonic() -> Duration {
    #[cfg(unix)]
    {
        use rustix::time::{ClockId, clock_gettime};
        let time = clock_gettime(ClockId::Monotonic);
        let seconds = u64::try_from(time.tv_sec).unwrap_or(0);
        let nanoseconds = u32::try_from(time.tv_nsec).unwrap_or(0);
        Duration::new(seconds, nanoseconds)
    }
    #[cfg(not(unix))]
    {
        use std::sync::OnceLock;
        use std::time::Instant;
        static EPOCH: OnceLock<Instant> = OnceLock::new();
        EPOCH.get_or_init(Instant::now).elapsed()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_does_not_go_back() {
        let times: Vec<Duration> = (0..1000).map(|_| monotonic()).collect();
        assert!(times.is_sorted());
    }
}
