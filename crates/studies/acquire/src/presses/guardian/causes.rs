//! Causes of late turns, readings and halts, and their counts.

use std::fmt;

/// Cause of a late turn of a guard thread, a late reading or a late halt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cause {
    /// The kernel woke the thread late, or kept it from a processor.
    Kernel,
    /// The work of the thread took too long.
    Program,
    /// The device was late: the thread was in time, or waited for an answer.
    Device,
    /// The kernel does not state how long the thread waited for a processor.
    Unknown,
}

/// Number of late events for each cause.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct CauseCounts {
    kernel: u64,
    program: u64,
    device: u64,
    unknown: u64,
}

impl CauseCounts {
    pub(super) fn add(&mut self, cause: Cause) {
        *match cause {
            Cause::Kernel => &mut self.kernel,
            Cause::Program => &mut self.program,
            Cause::Device => &mut self.device,
            Cause::Unknown => &mut self.unknown,
        } += 1;
    }

    pub(super) fn is_empty(&self) -> bool {
        self.kernel + self.program + self.device + self.unknown == 0
    }
}

impl fmt::Display for CauseCounts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let CauseCounts {
            kernel,
            program,
            device,
            unknown,
        } = self;
        write!(
            f,
            "{kernel} by the kernel, {program} by TacEva or a driver, {device} by a device or its link, {unknown} of unknown cause"
        )
    }
}

/// Remedy against a kernel that delays a thread with the scheduling policy `policy`.
pub(super) fn remedy(policy: &str) -> &'static str {
    match policy {
        "SCHED_FIFO" | "SCHED_RR" | "SCHED_DEADLINE" => {
            "stop other programs; the priority of this program is raised already"
        }
        _ => "stop other programs, or run with `chrt -f 10 taceva run …`",
    }
}
