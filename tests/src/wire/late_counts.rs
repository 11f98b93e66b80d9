//! Late turns of the guard and stale readings, as studies print them.

/// Counts by cause. The struct gets no further field.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LateCounts {
    /// The kernel woke the guard late, or kept it from a processor.
    pub kernel: u64,
    /// The work of the program or of a driver took too long.
    pub program: u64,
    /// A device or its link was late.
    pub device: u64,
    /// The kernel does not state the cause.
    pub unknown: u64,
}

/// Begin of the line with the counts of a session, and of a line about one miss.
const COUNTS: &str = "taceva: late in this session: ";
const ONE: &str = "taceva: late: ";

impl LateCounts {
    /// Adds the counts of every session in the output of a study.
    pub fn add(&mut self, said: &str) {
        for counts in said.lines().filter_map(|line| line.strip_prefix(COUNTS)) {
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
    }

    /// Lines about single misses in the output of a study.
    pub fn lines(said: &str) -> impl Iterator<Item = &str> {
        said.lines().filter(|line| line.starts_with(ONE))
    }
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
    }
}
