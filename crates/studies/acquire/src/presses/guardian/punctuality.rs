//! Shows late turns, stale readings and late halts with their causes, and shows their counts when the session ends. Guard threads only store lines: a
//! terminal or pipe may block the writing thread.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use taceva_core::Progress;

use super::halt_counts::HaltCounts;
use super::halts::Halted;
use super::misses::Misses;
use super::thread_facts::policy;
use super::turn::Turn;

/// Interval at which stored lines are shown.
const SHOW: Duration = Duration::from_millis(20);

/// Counts late turns, stale readings and halts, and shows the late ones.
pub(super) struct Punctuality<'a> {
    noted: Mutex<Noted>,
    progress: &'a dyn Progress,
}

#[derive(Default)]
struct Noted {
    misses: Misses,
    halts: HaltCounts,
    /// Log lines that are not shown yet.
    lines: Vec<String>,
}

impl<'a> Punctuality<'a> {
    pub(super) fn new(progress: &'a dyn Progress) -> Punctuality<'a> {
        let noted = Mutex::default();
        Punctuality { noted, progress }
    }

    fn lock(&self) -> MutexGuard<'_, Noted> {
        self.noted.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Records a turn of the calling thread, which guards `signal`.
    pub(super) fn turn(&self, signal: &str, turn: &Turn) {
        if let Some(late) = turn.late() {
            let policy = policy();
            let mut noted = self.lock();
            let line = noted.misses.turn(signal, policy, turn, &late);
            noted.lines.extend(line);
        }
    }

    /// Records a stale reading.
    pub(super) fn stale(&self, age_s: f64, found_s: f64) {
        self.lock().misses.stale(age_s, found_s);
    }

    /// Adds a halt of a motion.
    pub(super) fn halted(&self, halted: &Halted) {
        let policy = policy();
        let mut noted = self.lock();
        let line = noted.halts.add(halted, policy);
        noted.lines.extend(line);
    }

    /// Updates the time. The cause of a stale reading may then be known.
    pub(super) fn settle(&self, now_s: f64) {
        let mut noted = self.lock();
        let line = noted.misses.settle(now_s);
        noted.lines.extend(line);
    }

    /// Shows lines until `is_over` is true. Runs on a separate thread, because output may block.
    pub(super) fn show_until(&self, is_over: &AtomicBool) {
        while !is_over.load(Ordering::Acquire) {
            std::thread::sleep(SHOW);
            self.show();
        }
    }

    /// Shows the remaining lines, and the counts of the session. Returns a warning if halts were late.
    pub(super) fn end(self) -> Option<String> {
        self.show();
        let noted = self.noted.into_inner();
        let noted = noted.unwrap_or_else(PoisonError::into_inner);
        let counts = [noted.misses.summary(), noted.halts.summary()];
        let counts = counts.iter().flatten();
        counts.for_each(|line| self.progress.remark(line));
        noted.halts.warning()
    }

    fn show(&self) {
        // The lock is released before a line is shown.
        let lines = std::mem::take(&mut self.lock().lines);
        lines.iter().for_each(|line| self.progress.remark(line));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Test observer that stores remarks.
    #[derive(Default)]
    struct Remarks(Mutex<Vec<String>>);

    impl Progress for Remarks {
        fn is_cancelled(&self) -> bool {
            false
        }
        fn remark(&self, words: &str) {
            self.0.lock().expect("whole").push(words.to_owned());
        }
    }

    /// Turn that began at 10 s and took `took_s`. Its thread waited for a processor for half of this time.
    fn turn(took_s: f64) -> Turn {
        Turn {
            began_s: 10.0,
            due_s: 10.0,
            awake_s: 10.0,
            ended_s: 10.0 + took_s,
            queued_s: Some(took_s / 2.0),
        }
    }

    #[test]
    fn late_turns_and_stale_readings_are_shown_by_another_thread_and_their_counts_at_the_end() {
        let remarks = Remarks::default();
        let punctuality = Punctuality::new(&remarks);
        let shown = || remarks.0.lock().expect("whole").len();
        punctuality.turn("pose", &turn(0.02));
        punctuality.turn("force", &turn(0.09));
        assert_eq!(shown(), 0, "a guard thread shows nothing");
        punctuality.show();
        punctuality.show();
        assert_eq!(shown(), 1);
        punctuality.stale(0.06, 20.0);
        punctuality.settle(20.1);
        punctuality.settle(20.5);
        assert_eq!(shown(), 1, "a guard thread shows nothing");
        assert_eq!(punctuality.end(), None, "no halt was late");
        let remarks = remarks.0.into_inner().expect("whole");
        let [late, stale, counts] = &remarks[..] else {
            panic!("{remarks:?}");
        };
        assert!(late.starts_with("late: the guard of the force took 90 ms"));
        assert!(stale.starts_with("late: the newest reading is 60 ms old"));
        assert!(counts.contains("1 by the kernel, 0 by TacEva or a driver, 1 by a device"));
    }

    #[test]
    fn a_session_in_time_shows_nothing() {
        let remarks = Remarks::default();
        let punctuality = Punctuality::new(&remarks);
        punctuality.turn("force", &turn(0.04));
        punctuality.settle(20.0);
        assert_eq!(punctuality.end(), None);
        assert!(remarks.0.into_inner().expect("whole").is_empty());
    }
}
