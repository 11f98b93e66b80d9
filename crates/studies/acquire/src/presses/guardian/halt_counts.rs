//! Counts, durations and causes of the halts of a session.

use super::causes::{Cause, CauseCounts, remedy};
use super::halts::Halted;

/// Maximum number of late halts that are logged with a line each.
const MOST_LINES: u32 = 10;

/// Number and longest durations of the halts of a session.
#[derive(Debug, Default)]
pub(super) struct HaltCounts {
    halts: u64,
    /// Longest duration of a driver's halt call, s.
    call_s: f64,
    /// Longest time from the decision to halt until the tip rested, s; `None` if no rest was reported.
    rest_s: Option<f64>,
    late: CauseCounts,
    lines: u32,
}

impl HaltCounts {
    /// Counts a halt of a thread with the scheduling policy `policy`. Returns a log line for each of the first `MOST_LINES` late halts.
    pub(super) fn add(&mut self, halted: &Halted, policy: &str) -> Option<String> {
        self.halts += 1;
        let call_s = halted.call.took_s();
        self.call_s = self.call_s.max(call_s);
        self.rest_s = halted
            .rest_s
            .map(|rest_s| self.rest_s.map_or(rest_s, |most_s| most_s.max(rest_s)))
            .or(self.rest_s);
        let cause = halted.late()?;
        self.late.add(cause);
        self.lines += 1;
        (self.lines <= MOST_LINES).then(|| words(halted, cause, policy))
    }

    /// Counts of the session's halts in one line; `None` without a halt.
    pub(super) fn summary(&self) -> Option<String> {
        let rest = self.rest_s.map_or(String::new(), |rest_s| {
            format!(", at rest within {:.1} ms", rest_s * 1e3)
        });
        (self.halts > 0).then(|| {
            format!(
                "halts in this session: {}, driver calls within {:.1} ms{rest}; late: {}",
                self.halts,
                self.call_s * 1e3,
                self.late
            )
        })
    }

    /// Warning for the recording and its report; `None` if no halt was late.
    pub(super) fn warning(&self) -> Option<String> {
        let summary = self.summary().filter(|_| !self.late.is_empty())?;
        Some(format!("the robot was halted late: {summary}"))
    }
}

fn words(halted: &Halted, cause: Cause, policy: &str) -> String {
    let call_ms = halted.call.took_s() * 1e3;
    let head = format!("late: the stop of the robot took {call_ms:.0} ms in its driver");
    let spent = halted.call.spent.unwrap_or_default();
    let [queued_ms, ran_ms] = [spent.queued_s, spent.ran_s].map(|seconds| seconds * 1e3);
    match cause {
        Cause::Kernel => format!(
            "{head}; its thread ({policy}) waited {queued_ms:.0} ms for a processor: {}",
            remedy(policy)
        ),
        Cause::Program => format!(
            "{head}, of which the driver worked {ran_ms:.0} ms: report this line with the driver of the robot"
        ),
        Cause::Device => {
            let delay = match (halted.moved_on(), halted.rest_s) {
                (false, _) => "which waited for its answer".to_owned(),
                (true, Some(rest_s)) => {
                    format!("and the tip rested after {:.0} ms", rest_s * 1e3)
                }
                (true, None) => {
                    format!(
                        "and the tip still moved after {:.0} ms",
                        halted.moved_s * 1e3
                    )
                }
            };
            format!(
                "{head}, {delay}: the robot or its link was late; check network and load of its controller"
            )
        }
        Cause::Unknown => format!(
            "{head}; this kernel does not state how long its thread ({policy}) waited for a processor: {}",
            remedy(policy)
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::presses::guardian::halts::HaltCall;
    use crate::presses::guardian::thread_facts::ThreadTimes;

    fn halted(took_ms: f64, queued_ms: f64, rest_ms: Option<f64>) -> Halted {
        let call = HaltCall {
            decided_s: 50.0,
            returned_s: 50.0 + took_ms / 1e3,
            spent: Some(ThreadTimes {
                ran_s: 0.0,
                queued_s: queued_ms / 1e3,
            }),
        };
        // Reports come every 10 ms.
        Halted {
            call,
            rest_s: rest_ms.map(|rest_ms| rest_ms / 1e3),
            moved_s: rest_ms.map_or(0.0, |rest_ms| (rest_ms - 10.0) / 1e3),
        }
    }

    #[test]
    fn a_late_halt_names_driver_wait_and_remedy_and_the_session_ends_with_counts() {
        let mut counts = HaltCounts::default();
        assert_eq!((counts.summary(), counts.warning()), (None, None));
        assert_eq!(
            counts.add(&halted(3.0, 0.0, Some(14.0)), "SCHED_FIFO"),
            None
        );
        assert_eq!(counts.warning(), None);
        let line = counts.add(&halted(41.0, 1.0, None), "SCHED_FIFO");
        let line = line.expect("late");
        for words in ["took 41 ms", "waited for its answer", "check network"] {
            assert!(line.contains(words), "{line}");
        }
        let line = counts.add(&halted(41.0, 38.0, None), "SCHED_OTHER");
        let line = line.expect("late");
        for words in [
            "(SCHED_OTHER)",
            "waited 38 ms for a processor",
            "chrt -f 10",
        ] {
            assert!(line.contains(words), "{line}");
        }
        let line = counts.add(&halted(2.0, 0.0, Some(81.0)), "SCHED_FIFO");
        assert!(line.expect("late").contains("rested after 81 ms"));
        let expected = "halts in this session: 4, driver calls within 41.0 ms, at rest within 81.0 ms; late: 1 by the kernel, 0 by TacEva or a driver, 2 by a device or its link, 0 of unknown cause";
        assert_eq!(counts.summary().as_deref(), Some(expected));
        let warning = counts.warning().expect("three were late");
        assert_eq!(warning, format!("the robot was halted late: {expected}"));
    }

    #[test]
    fn a_program_of_raised_priority_is_not_advised_to_raise_it() {
        let mut counts = HaltCounts::default();
        let line = counts.add(&halted(41.0, 38.0, None), "SCHED_FIFO");
        let line = line.expect("late");
        assert!(!line.contains("chrt"), "{line}");
        assert!(line.contains("stop other programs"), "{line}");
    }

    #[test]
    fn a_busy_session_has_few_lines_about_halts() {
        let mut counts = HaltCounts::default();
        let lines = (0..30).filter_map(|_| counts.add(&halted(41.0, 38.0, None), "SCHED_OTHER"));
        assert_eq!(lines.count(), 10);
    }
}
