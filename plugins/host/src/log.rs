//! What plugins log, on its way to whoever listens: never more than people read.

use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use crate::library::{Level, Log};

/// Lines that pass at once.
const BURST: u32 = 100;
/// Then one passes each time after so long.
const EVERY: Duration = Duration::from_millis(50);

/// What such lines are about that say how many there were.
const TARGET: &str = "log";

/// `log`, told of 100 lines at once and of 20 a second from then on; of the others it is told how many they were.
pub(crate) fn limited(log: Log) -> Log {
    let limited = Limited {
        log,
        state: Mutex::default(),
    };
    Box::new(move |level, target, message| {
        limited.tell(Instant::now(), (level, target, message));
    })
}

/// Tells `log` that lines were lost.
pub(crate) fn tell_lost(log: &Log, lost: u64) {
    if lost > 0 {
        log(Level::Warn, TARGET, &format!("lines left out: {lost}"));
    }
}

struct Limited {
    log: Log,
    state: Mutex<State>,
}

#[derive(Default)]
struct State {
    /// When all lines that passed would have passed, had they come one at a time.
    due: Option<Instant>,
    left_out: u64,
}

impl Limited {
    fn tell(&self, now: Instant, (level, target, message): (Level, &str, &str)) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let due = state.due.map_or(now, |due| due.max(now));
        if due.saturating_duration_since(now) >= EVERY * BURST {
            state.left_out += 1;
            return;
        }
        state.due = Some(due + EVERY);
        let lost = std::mem::take(&mut state.left_out);
        drop(state);
        tell_lost(&self.log, lost);
        (self.log)(level, target, message);
    }
}

impl Drop for Limited {
    fn drop(&mut self) {
        let state = self.state.get_mut().unwrap_or_else(PoisonError::into_inner);
        let lost = std::mem::take(&mut state.left_out);
        tell_lost(&self.log, lost);
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;

    #[test]
    fn a_flood_is_cut_and_counted_and_what_comes_after_it_passes() {
        let told = Arc::new(Mutex::new(Vec::new()));
        let lines = Arc::clone(&told);
        let limited = Limited {
            log: Box::new(move |_, _, message| {
                lines.lock().expect("whole").push(message.to_owned());
            }),
            state: Mutex::default(),
        };
        let begin = Instant::now();
        let tell = |at, message: &str| limited.tell(begin + at, (Level::Info, "eye", message));
        for number in 0..1_000 {
            tell(Duration::ZERO, &format!("line {number}"));
        }
        assert_eq!(told.lock().expect("whole").len(), 100);
        tell(EVERY, "later");
        tell(EVERY, "too many again");
        drop(limited);
        let told = told.lock().expect("whole");
        let last: Vec<&str> = told[99..].iter().map(String::as_str).collect();
        let expected = [
            "line 99",
            "lines left out: 900",
            "later",
            "lines left out: 1",
        ];
        assert_eq!(last, expected);
    }
}
