//! Shows late turns and stale readings of a session with their causes, and their counts at its end.

use std::sync::{Mutex, MutexGuard, PoisonError};

use taceva_core::Progress;

use super::misses::Misses;
use super::thread_facts::policy;
use super::turn::Turn;

/// Counts late turns and stale readings, and shows them.
pub(super) struct Punctuality<'a> {
    misses: Mutex<Misses>,
    progress: &'a dyn Progress,
}

impl<'a> Punctuality<'a> {
    pub(super) fn new(progress: &'a dyn Progress) -> Punctuality<'a> {
        let misses = Mutex::default();
        Punctuality { misses, progress }
    }

    fn lock(&self) -> MutexGuard<'_, Misses> {
        self.misses.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Takes a turn of the calling thread, which guards `signal`.
    pub(super) fn turn(&self, signal: &str, turn: &Turn) {
        if let Some(late) = turn.late() {
            let words = self.lock().turn(signal, policy(), turn, &late);
            self.show(words);
        }
    }

    /// Takes a reading that was found stale.
    pub(super) fn stale(&self, age_s: f64, found_s: f64) {
        self.lock().stale(age_s, found_s);
    }

    /// Shows a stale reading once its cause is known.
    pub(super) fn settle(&self, now_s: f64) {
        let words = self.lock().settle(now_s);
        self.show(words);
    }

    /// Shows the counts of the session.
    pub(super) fn end(self) {
        let misses = self.misses.into_inner();
        let words = misses.unwrap_or_else(PoisonError::into_inner).summary();
        words.iter().for_each(|words| self.progress.remark(words));
    }

    fn show(&self, words: Option<String>) {
        words.iter().for_each(|words| self.progress.remark(words));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Progress that keeps its remarks.
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

    /// Turn from 10 s on, of which the thread waited for a processor for half of the time.
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
    fn late_turns_and_stale_readings_are_shown_at_once_and_their_counts_at_the_end() {
        let remarks = Remarks::default();
        let punctuality = Punctuality::new(&remarks);
        punctuality.turn("pose", &turn(0.02));
        punctuality.turn("force", &turn(0.09));
        punctuality.stale(0.06, 20.0);
        punctuality.settle(20.1);
        punctuality.settle(20.5);
        punctuality.end();
        let remarks = remarks.0.into_inner().expect("whole");
        let [late, stale, counts] = &remarks[..] else {
            panic!("{remarks:?}");
        };
        assert!(late.starts_with("late: the guard of the force took 90 ms"));
        assert!(stale.starts_with("late: the newest reading was from 60 ms ago"));
        assert!(counts.contains("1 by the kernel, 0 by TacEva or a driver, 1 by a device"));
    }

    #[test]
    fn a_session_in_time_shows_nothing() {
        let remarks = Remarks::default();
        let punctuality = Punctuality::new(&remarks);
        punctuality.turn("force", &turn(0.04));
        punctuality.settle(20.0);
        punctuality.end();
        assert!(remarks.0.into_inner().expect("whole").is_empty());
    }
}
