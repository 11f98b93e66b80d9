//! The time that a child took: of whoever called it, and of the processors.

use std::fmt;
use std::time::Duration;

/// A child that lived shorter slows nothing.
const SHORT: Duration = Duration::from_secs(2);
/// Unit of the times in `/proc`, whatever the kernel counts in.
const TICKS_PER_SECOND: u64 = 100;

/// The time that a child took until its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Usage {
    /// From its start to its end.
    pub whole: Duration,
    /// Processor time of all its threads.
    pub processor: Duration,
    /// In which somebody waited for an answer.
    pub calls: Duration,
}

impl Usage {
    /// True for a child that keeps more than two processors busy, or is waited for more than half of its life.
    pub(crate) fn is_much(&self) -> bool {
        self.whole > SHORT && (self.processor > self.whole * 2 || self.calls > self.whole / 2)
    }
}

impl fmt::Display for Usage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "took time: {:.1} s of {:.1} s were spent waiting for its answers, and it used {:.1} s of processor time",
            self.calls.as_secs_f64(),
            self.whole.as_secs_f64(),
            self.processor.as_secs_f64()
        )
    }
}

/// The processor time of a process and its threads, until it is waited for; zero where the system does not say.
pub(super) fn processor_time(process: u32) -> Duration {
    let text = std::fs::read_to_string(format!("/proc/{process}/stat")).unwrap_or_default();
    // The name, which may hold anything, ends with the last bracket; the times of user and system stand twelfth and thirteenth behind it.
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
