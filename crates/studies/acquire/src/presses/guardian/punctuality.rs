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
