//! Time that a child process used: run time, processor time, and time of calls.

use std::fmt;
use std::time::Duration;

/// Run time below which the usage of a child is never reported.
const SHORT: Duration = Duration::from_secs(2);
/// Ticks per second of the times in `/proc`, a fixed interface of the kernel.
const TICKS_PER_SECOND: u64 = 100;

/// Time that a child process used until its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Usage {
    /// Run time.
    pub whole: Duration,
    /// Processor time of all its threads.
    pub processor: Duration,
    /// Total time in which callers waited for replies.
    pub calls: Duration,
}

impl Usage {
    /// True if the child kept more than two processors busy, or callers waited for more than half of its run time.
    pub(crate) fn is_much(&self) -> bool {
        self.whole > SHORT && (self.processor > self.whole * 2 || self.calls > self.whole / 2)
    }
}

impl fmt::Display for Usage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "callers waited {:.1} s of {:.1} s for its replies, with waits for frames and readings, and it used {:.1} s of processor time",
            self.calls.as_secs_f64(),
            self.whole.as_secs_f64(),
            self.processor.as_secs_f64()
        )
    }
}

/// Processor time of a process and its threads, readable until it is reaped; zero if unknown.
pub(super) fn processor_time(process: u32) -> Duration {
    let text = std::fs::read_to_string(format!("/proc/{process}/stat")).unwrap_or_default();
    // The name may contain any character and ends with the last bracket. User and system time are words 12 and 13 after it.
    let words = text.rsplit_once(')').map_or("", |(_, rest)| rest);
    let ticks = words.split_whitespace().skip(11).take(2);
    let ticks: u64 = ticks.filter_map(|word| word.parse::<u64>().ok()).sum();
    Duration::from_millis(ticks.saturating_mul(1000) / TICKS_PER_SECOND)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_child_that_burns_processors_or_is_waited_for_is_named_and_another_is_not() {
        let seconds = Duration::from_secs;
        let usage = |whole, processor, calls| Usage {
            whole: seconds(whole),
            processor: seconds(processor),
            calls: seconds(calls),
        };
        assert!(usage(10, 640, 1).is_much() && usage(10, 1, 8).is_much());
        assert!(!usage(10, 15, 4).is_much() && !usage(1, 64, 1).is_much());
        let said = usage(10, 640, 1).to_string();
        assert!(said.contains("640.0 s of processor time"), "{said}");
    }

    #[test]
    fn this_process_has_used_some_time() {
        let begun = std::time::Instant::now();
        while begun.elapsed() < Duration::from_millis(50) {
            std::hint::spin_loop();
        }
        assert!(processor_time(std::process::id()) > Duration::ZERO);
    }
}
