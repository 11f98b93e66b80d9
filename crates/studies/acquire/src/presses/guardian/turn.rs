//! Turns of a guard thread: one reading each. A turn that takes too long has a cause.

use std::time::Duration;

use taceva_drivers::MonotonicClock;

use super::causes::Cause;
use super::thread_facts::ProcessorQueue;

/// Maximum duration of a punctual turn, s: the age from which a reading is stale.
const LONGEST_S: f64 = 0.05;
/// Maximum time that a turn is planned to rest and to wait for a reading, s.
const INTENDED_S: f64 = 0.025;

/// Times of a turn on the monotonic clock, s.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turn {
    pub(super) began_s: f64,
    /// Requested end of the rest before the turn, s.
    pub(super) due_s: f64,
    /// Actual end of the rest before the turn, s.
    pub(super) awake_s: f64,
    pub(super) ended_s: f64,
    /// Time, s, for which the thread was ready to run but had no processor; `None` if the kernel does not state it.
    pub(super) queued_s: Option<f64>,
}

/// A turn that took too long.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Late {
    pub(super) cause: Cause,
    /// Duration of the turn, s.
    pub(super) took_s: f64,
    /// Known delay of the turn by the kernel, s.
    pub(super) kernel_s: f64,
}

impl Turn {
    /// Duration and cause of the turn if it took too long.
    pub(super) fn late(&self) -> Option<Late> {
        let took_s = self.ended_s - self.began_s;
        if took_s <= LONGEST_S {
            return None;
        }
        let woken_late_s = (self.awake_s - self.due_s).max(0.0);
        let kernel_s = self.queued_s.unwrap_or(0.0).max(woken_late_s);
        let cause = match self.queued_s {
            _ if kernel_s >= (took_s - INTENDED_S) / 2.0 => Cause::Kernel,
            Some(_) => Cause::Program,
            None => Cause::Unknown,
        };
        Some(Late {
            cause,
            took_s,
            kernel_s,
        })
    }
}

/// Timer of the turns of the thread that created it.
pub(super) struct TurnTimer {
    queue: ProcessorQueue,
    /// Total waiting time for a processor until the end of the last turn, s; `None` if the kernel does not state it.
    queued_s: Option<f64>,
    began_s: f64,
    due_s: f64,
    awake_s: f64,
}

impl TurnTimer {
    pub(super) fn of_this_thread() -> TurnTimer {
        let queue = ProcessorQueue::of_this_thread();
        let now_s = MonotonicClock.now_s();
        TurnTimer {
            queued_s: queue.waited_s(),
            queue,
            began_s: now_s,
            due_s: now_s,
            awake_s: now_s,
        }
    }

    /// Restarts the count of the time for which the thread waits for a processor. The next turn then does not include earlier waits.
    pub(super) fn restart(&mut self) {
        self.queued_s = self.queue.waited_s();
    }

    /// Begins a turn, and sleeps for `rest`.
    pub(super) fn begin(&mut self, rest: Duration) {
        self.began_s = MonotonicClock.now_s();
        self.due_s = self.began_s + rest.as_secs_f64();
        if !rest.is_zero() {
            std::thread::sleep(rest);
        }
        self.awake_s = MonotonicClock.now_s();
    }

    /// Ends the turn, and returns its times.
    pub(super) fn end(&mut self) -> Turn {
        let ended_s = MonotonicClock.now_s();
        let queued_s = self.queue.waited_s();
        let before_s = std::mem::replace(&mut self.queued_s, queued_s);
        Turn {
            began_s: self.began_s,
            due_s: self.due_s,
            awake_s: self.awake_s,
            ended_s,
            queued_s: queued_s
                .zip(before_s)
                .map(|(queued_s, before_s)| queued_s - before_s),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Turn that began at 100 s and rested until 5 ms later. It woke after `awake_ms` and ended after `ended_ms`.
    fn turn(awake_ms: f64, ended_ms: f64, queued_ms: Option<f64>) -> Turn {
        Turn {
            began_s: 100.0,
            due_s: 100.005,
            awake_s: 100.0 + awake_ms / 1e3,
            ended_s: 100.0 + ended_ms / 1e3,
            queued_s: queued_ms.map(|queued_ms| queued_ms / 1e3),
        }
    }

    fn cause(turn: Turn) -> Option<Cause> {
        turn.late().map(|late| late.cause)
    }

    #[test]
    fn a_turn_within_the_age_of_a_stale_reading_is_in_time() {
        assert_eq!(cause(turn(5.1, 49.0, Some(40.0))), None);
    }

    #[test]
    fn a_thread_that_wakes_late_is_late_by_the_kernel() {
        for queued in [None, Some(0.0)] {
            assert_eq!(cause(turn(65.0, 75.0, queued)), Some(Cause::Kernel));
        }
    }

    #[test]
    fn a_thread_that_waits_for_a_processor_amid_its_work_is_late_by_the_kernel() {
        let late = turn(5.1, 90.0, Some(61.0)).late().expect("late");
        assert_eq!(late.cause, Cause::Kernel);
        assert!((late.took_s - 0.09).abs() < 1e-9 && (late.kernel_s - 0.061).abs() < 1e-9);
    }

    #[test]
    fn a_thread_that_had_its_processor_is_late_by_its_own_work() {
        assert_eq!(cause(turn(5.1, 90.0, Some(2.0))), Some(Cause::Program));
    }

    #[test]
    fn a_thread_whose_kernel_states_no_waiting_is_late_by_an_unknown_cause() {
        assert_eq!(cause(turn(5.1, 90.0, None)), Some(Cause::Unknown));
    }

    #[test]
    fn the_times_of_a_turn_are_those_of_its_thread() {
        let mut timer = TurnTimer::of_this_thread();
        timer.begin(Duration::from_millis(60));
        let turn = timer.end();
        let rest_s = turn.due_s - turn.began_s;
        assert!((rest_s - 0.06).abs() < 1e-6, "{turn:?}");
        assert!(
            turn.awake_s >= turn.due_s && turn.ended_s >= turn.awake_s,
            "{turn:?}"
        );
        assert!(turn.queued_s.is_none_or(|queued_s| queued_s >= 0.0));
    }
}
