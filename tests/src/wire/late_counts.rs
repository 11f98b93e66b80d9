//! Late turns of the guard, stale readings and halts, as studies print them.

/// Counts of late events by cause. The struct gets no further field.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LateCounts {
    /// Number of events for which the kernel woke the guard late, or kept it from a processor.
    pub kernel: u64,
    /// Number of events for which the program or a driver worked too long.
    pub program: u64,
    /// Number of events for which a device or its link was late.
    pub device: u64,
    /// Number of events for which the kernel does not state the cause.
    pub unknown: u64,
}

/// Number and durations of halts of motions. The struct gets no further field.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HaltTimes {
    /// Number of halts.
    pub halts: u64,
    /// Longest call of a driver's halt, ms.
    pub call_ms: f64,
    /// Longest time from the decision to halt until the robot reported rest, ms.
    pub rest_ms: f64,
    /// Late halts by cause.
    pub late: LateCounts,
}

/// Start of the line with the counts of late events in a session. [`HALTS`] starts the line about halts, and [`ONE`] a line about one late event.
const COUNTS: &str = "taceva: late in this session: ";
const HALTS: &str = "taceva: halts in this session: ";
const ONE: &str = "taceva: late: ";

impl LateCounts {
    /// Adds the counts of every session in the output of a study.
    pub fn add(&mut self, said: &str) {
        let counts = said.lines().filter_map(|line| line.strip_prefix(COUNTS));
        counts.for_each(|counts| self.add_session(counts));
    }

    /// Adds counts such as `3 by the kernel, 1 by TacEva or a driver, …`.
    fn add_session(&mut self, counts: &str) {
        let numbers = counts.split(", ").map(|count| {
            let number = count.split(' ').next();
            number.and_then(|number| number.parse().ok()).unwrap_or(0)
        });
        let numbers: Vec<u64> = numbers.collect();
        if let &[kernel, program, device, unknown] = &numbers[..] {
            self.kernel += kernel;
            self.program += program;
            self.device += device;
            self.unknown += unknown;
        }
    }

    /// Number of late events, over all causes.
    pub fn total(&self) -> u64 {
        self.kernel + self.program + self.device + self.unknown
    }

    /// Lines in the output of a study that describe one late event each.
    pub fn lines(said: &str) -> impl Iterator<Item = &str> {
        said.lines().filter(|line| line.starts_with(ONE))
    }
}

impl HaltTimes {
    /// Adds the halts of every session in the output of a study.
    pub fn add(&mut self, said: &str) {
        for session in said.lines().filter_map(|line| line.strip_prefix(HALTS)) {
            let Some((times, late)) = session.split_once("; late: ") else {
                continue;
            };
            self.late.add_session(late);
            let halts = times.split(',').next().and_then(|halts| halts.parse().ok());
            self.halts += halts.unwrap_or(0);
            self.call_ms = self
                .call_ms
                .max(number_after(times, "driver calls within "));
            self.rest_ms = self.rest_ms.max(number_after(times, "at rest within "));
        }
    }
}

/// Number after `words`; 0 if they are absent.
fn number_after(text: &str, words: &str) -> f64 {
    let after = text.split_once(words).map(|(_, after)| after);
    let number = after.and_then(|after| after.split(' ').next());
    number.and_then(|number| number.parse().ok()).unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_of_all_sessions_are_added_and_single_misses_are_lines() {
        let said = "taceva: late: the guard of the force took 84 ms for a reading; …\n\
            taceva: late in this session: 3 by the kernel, 1 by TacEva or a driver, 2 by a device or its link, 0 of unknown cause\n\
            taceva: stopped\n\
            taceva: late in this session: 4 by the kernel, 0 by TacEva or a driver, 0 by a device or its link, 5 of unknown cause\n";
        let mut counts = LateCounts::default();
        counts.add(said);
        let expected = LateCounts {
            kernel: 7,
            program: 1,
            device: 2,
            unknown: 5,
        };
        assert_eq!(counts, expected);
        assert_eq!(LateCounts::lines(said).count(), 1);
        assert_eq!(counts.total(), 15);
    }

    #[test]
    fn halts_of_all_sessions_are_added_with_their_longest_times() {
        let said = "taceva: halts in this session: 4, driver calls within 41.0 ms, at rest within 18.5 ms; late: 1 by the kernel, 0 by TacEva or a driver, 2 by a device or its link, 0 of unknown cause\n\
            taceva: halts in this session: 1, driver calls within 2.5 ms; late: 0 by the kernel, 0 by TacEva or a driver, 0 by a device or its link, 0 of unknown cause\n";
        let mut halts = HaltTimes::default();
        halts.add(said);
        let expected = HaltTimes {
            halts: 5,
            call_ms: 41.0,
            rest_ms: 18.5,
            late: LateCounts {
                kernel: 1,
                device: 2,
                ..LateCounts::default()
            },
        };
        assert_eq!(halts, expected);
    }
}
