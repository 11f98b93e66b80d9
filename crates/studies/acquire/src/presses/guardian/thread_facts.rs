//! Facts that Linux reports about the calling thread: its waiting time for a processor, and its scheduling policy.

use std::fs::File;
use std::io::{Read, Seek};

/// Statistics file of a thread, with its waiting time for a processor; `None` if the system has no such file.
pub(super) struct ProcessorQueue(Option<File>);

impl ProcessorQueue {
    /// Opens the statistics of the calling thread, if the system has them.
    pub(super) fn of_this_thread() -> ProcessorQueue {
        ProcessorQueue(File::open("/proc/thread-self/schedstat").ok())
    }

    /// Waiting time for a processor since the start of the thread, s; `None` if the system does not state it.
    pub(super) fn waited_s(&self) -> Option<f64> {
        Some(self.times()?.queued_s)
    }

    /// Times of the thread since its start; `None` if the system does not state them.
    pub(super) fn times(&self) -> Option<ThreadTimes> {
        let mut file = self.0.as_ref()?;
        let mut bytes = [0; 128];
        file.rewind().ok()?;
        let count = file.read(&mut bytes).ok()?;
        ThreadTimes::of(std::str::from_utf8(&bytes[..count]).ok()?)
    }
}

/// Times of a thread, s.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct ThreadTimes {
    /// Time for which the thread ran on a processor, s.
    pub(super) ran_s: f64,
    /// Time for which the thread was ready to run but had no processor, s.
    pub(super) queued_s: f64,
}

impl ThreadTimes {
    /// Parses the first two numbers of `schedstat`, which are in ns.
    fn of(schedstat: &str) -> Option<ThreadTimes> {
        let mut numbers = schedstat.split_whitespace();
        let mut next_s = || {
            let ns: u64 = numbers.next()?.parse().ok()?;
            Some(ns as f64 / 1e9)
        };
        Some(ThreadTimes {
            ran_s: next_s()?,
            queued_s: next_s()?,
        })
    }

    /// Times of the thread between `before` and `self`.
    pub(super) fn since(&self, before: &ThreadTimes) -> ThreadTimes {
        ThreadTimes {
            ran_s: self.ran_s - before.ran_s,
            queued_s: self.queued_s - before.queued_s,
        }
    }
}

/// Scheduling policy of the calling thread, such as `SCHED_FIFO`.
pub(super) fn policy() -> &'static str {
    let stat = std::fs::read_to_string("/proc/thread-self/stat").unwrap_or_default();
    policy_of(&stat)
}

/// Scheduling policy in `stat`, the text of `/proc/thread-self/stat`. The thread's name, in parentheses, may have blanks.
fn policy_of(stat: &str) -> &'static str {
    /// Numbers of fields in `stat`, counted from 1: `FIELD` contains the policy, and `FIRST` follows the name of the thread.
    const FIELD: usize = 41;
    const FIRST: usize = 3;
    let behind = stat.rsplit_once(')').map_or("", |(_, behind)| behind);
    match behind.split_whitespace().nth(FIELD - FIRST) {
        Some("0") => "SCHED_OTHER",
        Some("1") => "SCHED_FIFO",
        Some("2") => "SCHED_RR",
        Some("3") => "SCHED_BATCH",
        Some("5") => "SCHED_IDLE",
        Some("6") => "SCHED_DEADLINE",
        _ => "unknown scheduling policy",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn running_and_waiting_are_the_first_two_numbers_and_absent_without_both() {
        let expected = ThreadTimes {
            ran_s: 0.5,
            queued_s: 0.25,
        };
        let times = ThreadTimes::of("500000000 250000000 17\n");
        assert_eq!(times, Some(expected));
        for text in ["", "812345", "812345 none 17"] {
            assert_eq!(ThreadTimes::of(text), None, "{text}");
        }
    }

    #[test]
    fn a_policy_is_found_behind_a_name_with_blanks_and_brackets() {
        // Fields 3 to 40 are numbers without a meaning here.
        let stat = |policy: &str| {
            let fields: Vec<String> = (3..41).map(|field| field.to_string()).collect();
            format!("4711 (a guard) 1)) {} {policy} 0 0", fields.join(" "))
        };
        assert_eq!(policy_of(&stat("0")), "SCHED_OTHER");
        assert_eq!(policy_of(&stat("1")), "SCHED_FIFO");
        assert_eq!(policy_of("4711 (guard) S 1"), "unknown scheduling policy");
    }

    #[test]
    fn a_thread_of_this_machine_has_a_queue_that_only_grows() {
        let queue = ProcessorQueue::of_this_thread();
        if let (Some(before_s), Some(after_s)) = (queue.waited_s(), queue.waited_s()) {
            assert!(before_s <= after_s, "{before_s} {after_s}");
        }
    }
}
