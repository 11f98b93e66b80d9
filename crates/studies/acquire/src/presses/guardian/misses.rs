//! Late turns and stale readings of a session, by cause.

use super::causes::{Cause, CauseCounts, remedy};
use super::turn::{Late, Turn};

/// Maximum number of late turns and stale readings that are logged with a line each. A busy machine may have hundreds of them.
const MOST_LINES: u32 = 10;
/// Wait before a stale reading is attributed to the device, s. Until then, a late turn of the guard thread may still explain it.
const SETTLED_S: f64 = 0.2;

/// Numbers of misses (late turns of guard threads, and stale readings) of a session, by cause.
#[derive(Debug, Default)]
pub(super) struct Misses {
    counts: CauseCounts,
    /// Number of misses. The log has a line for each of the first `MOST_LINES`.
    lines: u32,
    /// End of the last late turn of a guard thread, s; `None` before the first.
    last_late_s: Option<f64>,
    /// Stale reading whose cause is not yet known, if any.
    stale: Option<Stale>,
}

#[derive(Clone, Copy, Debug)]
struct Stale {
    age_s: f64,
    found_s: f64,
}

impl Misses {
    /// Counts a late turn of the guard of `signal`, whose thread has the scheduling policy `policy`. Returns a log line for each of the first
    /// `MOST_LINES` misses.
    pub(super) fn turn(
        &mut self,
        signal: &str,
        policy: &str,
        turn: &Turn,
        late: &Late,
    ) -> Option<String> {
        self.last_late_s = Some(turn.ended_s);
        let explains = |stale: &Stale| turn.ended_s >= stale.found_s - stale.age_s;
        self.stale = self.stale.filter(|stale| !explains(stale));
        let [took_ms, kernel_ms] = [late.took_s, late.kernel_s].map(|seconds| seconds * 1e3);
        let head = format!("late: the guard of the {signal} took {took_ms:.0} ms for a reading");
        let words = match late.cause {
            Cause::Kernel => format!(
                "{head}; its thread ({policy}) waited {kernel_ms:.0} ms for a processor: {}",
                remedy(policy)
            ),
            Cause::Program | Cause::Device => format!(
                "{head}; its thread ({policy}) waited only {kernel_ms:.0} ms for a processor; TacEva or a driver used the rest: report this line with the drivers of the rig"
            ),
            Cause::Unknown => format!(
                "{head}; this kernel does not state how long its thread ({policy}) waited for a processor: {}",
                remedy(policy)
            ),
        };
        self.count(late.cause, words)
    }

    /// Records a stale reading.
    pub(super) fn stale(&mut self, age_s: f64, found_s: f64) {
        let is_explained = self
            .last_late_s
            .is_some_and(|late_s| late_s >= found_s - age_s);
        if !is_explained {
            self.stale.get_or_insert(Stale { age_s, found_s });
        }
    }

    /// Counts a stale reading that no late turn explains. Returns a log line for each of the first `MOST_LINES` misses.
    pub(super) fn settle(&mut self, now_s: f64) -> Option<String> {
        let stale = self
            .stale
            .take_if(|stale| now_s - stale.found_s > SETTLED_S)?;
        let words = format!(
            "late: the newest reading is {:.0} ms old, although the guard was in time. The device, its link or its driver is late: check cable, network and rate of the device",
            stale.age_s * 1e3
        );
        self.count(Cause::Device, words)
    }

    /// Numbers of late turns and stale readings in the session, in one line; `None` without any.
    pub(super) fn summary(mut self) -> Option<String> {
        if self.stale.is_some() {
            self.counts.add(Cause::Device);
        }
        let counts = self.counts;
        (!counts.is_empty()).then(|| format!("late in this session: {counts}"))
    }

    fn count(&mut self, cause: Cause, words: String) -> Option<String> {
        self.counts.add(cause);
        self.lines += 1;
        (self.lines <= MOST_LINES).then_some(words)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Turn that began at `began_s` and took `took_ms`, of which the thread waited for a processor for `queued_ms`.
    fn turn(began_s: f64, took_ms: f64, queued_ms: f64) -> Turn {
        Turn {
            began_s,
            due_s: began_s,
            awake_s: began_s,
            ended_s: began_s + took_ms / 1e3,
            queued_s: Some(queued_ms / 1e3),
        }
    }

    fn note(misses: &mut Misses, turn: Turn) -> Option<String> {
        let late = turn.late().expect("late");
        misses.turn("force", "SCHED_OTHER", &turn, &late)
    }

    #[test]
    fn a_late_turn_states_policy_and_waiting_and_whose_remedy_it_is() {
        let mut misses = Misses::default();
        let kernel = note(&mut misses, turn(10.0, 84.0, 71.0)).expect("a line");
        for words in [
            "84 ms",
            "(SCHED_OTHER)",
            "waited 71 ms for a processor",
            "chrt -f 10",
        ] {
            assert!(kernel.contains(words), "{kernel}");
        }
        let program = note(&mut misses, turn(11.0, 84.0, 3.0)).expect("a line");
        for words in ["waited only 3 ms for a processor", "drivers of the rig"] {
            assert!(program.contains(words), "{program}");
        }
        // The advice is not to do what was done already.
        let turn = turn(12.0, 84.0, 71.0);
        let raised =
            Misses::default().turn("force", "SCHED_FIFO", &turn, &turn.late().expect("late"));
        let raised = raised.expect("a line");
        assert!(
            !raised.contains("chrt") && raised.contains("stop other programs"),
            "{raised}"
        );
        let summary = misses.summary().expect("two");
        let expected = "late in this session: 1 by the kernel, 1 by TacEva or a driver, 0 by a device or its link, 0 of unknown cause";
        assert_eq!(summary, expected);
    }

    #[test]
    fn a_stale_reading_is_the_devices_unless_a_turn_of_the_guard_was_late() {
        let mut misses = Misses::default();
        misses.stale(0.061, 20.0);
        assert_eq!(misses.settle(20.1), None, "the reader may still come");
        let line = misses.settle(20.3).expect("it did not");
        assert!(line.contains("is 61 ms old"), "{line}");
        assert_eq!(misses.settle(21.0), None, "it is counted once");

        // The reader was late: it ends its turn after the watcher found the reading stale, or before.
        misses.stale(0.061, 30.0);
        note(&mut misses, turn(29.95, 120.0, 100.0));
        misses.stale(0.061, 30.1);
        assert_eq!(misses.settle(31.0), None);
        let summary = misses.summary().expect("two");
        assert!(summary.contains("1 by the kernel"), "{summary}");
        assert!(summary.contains("1 by a device"), "{summary}");
    }

    #[test]
    fn a_session_in_time_has_no_summary_and_a_busy_one_few_lines() {
        assert_eq!(Misses::default().summary(), None);
        let mut misses = Misses::default();
        let lines =
            (0..30).filter_map(|second| note(&mut misses, turn(f64::from(second), 84.0, 71.0)));
        assert_eq!(lines.count(), 10);
        let summary = misses.summary().expect("thirty");
        assert!(summary.contains("30 by the kernel"), "{summary}");
    }
}
