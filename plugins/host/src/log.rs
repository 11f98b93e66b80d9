//! Rate limit for log lines of plugins: a burst of 100, then 20 per second.

use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use crate::library::{Level, Log};

/// Burst size, lines.
const BURST: u32 = 100;
/// Interval between lines after the burst.
const EVERY: Duration = Duration::from_millis(50);

/// Target of the line that reports dropped lines.
const TARGET: &str = "log";

/// Rate-limited log: passes a burst of 100 lines, then 20 per second, and counts the rest.
pub(crate) struct Limited {
    log: Log,
    state: Mutex<State>,
}

#[derive(Default)]
struct State {
    /// Time from which the next line does not exceed the rate of one per [`EVERY`]; `None` before the first line.
    due: Option<Instant>,
    left_out: u64,
}

impl Limited {
    pub(crate) fn new(log: Log) -> Limited {
        Limited {
            log,
            state: Mutex::default(),
        }
    }

    /// Passes a line on, or counts it if the limit is exceeded.
    pub(crate) fn tell(&self, level: Level, target: &str, message: &str) {
        self.tell_at(Instant::now(), level, target, message);
    }

    /// Counts lines that the child dropped before they reached this log.
    pub(crate) fn lose(&self, count: u64) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        state.left_out = state.left_out.saturating_add(count);
    }

    fn tell_at(&self, now: Instant, level: Level, target: &str, message: &str) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let due = state.due.map_or(now, |due| due.max(now));
        if due.saturating_duration_since(now) >= EVERY * BURST {
            state.left_out = state.left_out.saturating_add(1);
            return;
        }
        state.due = Some(due + EVERY);
        let left_out = std::mem::take(&mut state.left_out);
        drop(state);
        self.tell_left_out(left_out);
        (self.log)(level, target, message);
    }

    fn tell_left_out(&self, count: u64) {
        if count > 0 {
            let message = format!("lines left out: {count}");
            (self.log)(Level::Warn, TARGET, &message);
        }
    }
}

impl Drop for Limited {
    fn drop(&mut self) {
        let state = self.state.get_mut().unwrap_or_else(PoisonError::into_inner);
        let left_out = std::mem::take(&mut state.left_out);
        self.tell_left_out(left_out);
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;

    #[test]
    fn a_flood_is_cut_and_counted_and_what_comes_after_it_passes() {
        let logged = Arc::new(Mutex::new(Vec::new()));
        let lines = Arc::clone(&logged);
        let limited = Limited::new(Box::new(move |_, _, message| {
            lines.lock().expect("whole").push(message.to_owned());
        }));
        let begin = Instant::now();
        let tell = |at, message: &str| limited.tell_at(begin + at, Level::Info, "eye", message);
        for number in 0..1_000 {
            tell(Duration::ZERO, &format!("line {number}"));
        }
        assert_eq!(logged.lock().expect("whole").len(), 100);
        tell(EVERY, "later");
        tell(EVERY, "too many again");
        limited.lose(41);
        drop(limited);
        let logged = logged.lock().expect("whole");
        let last: Vec<&str> = logged[99..].iter().map(String::as_str).collect();
        let expected = [
            "line 99",
            "lines left out: 900",
            "later",
            "lines left out: 42",
        ];
        assert_eq!(last, expected);
    }
}
