//! The threads that look on, as events in simulated time, and when each is due: one reads the transducer, the other looks at the robot and
//! hears wishes.
//!
//! When a thread is due is fixed, and when it gets the processor is drawn; so what it shows to the supervisor falls between any two calls of
//! the run and into the middle of its motions. A thread that needs the supervisor while the run has it waits, as it does at a lock.

use taceva_core::{Pose, Stamp, Wrench};

use super::draws::Draws;
use taceva_protocol::{Cancel, SharedSupervisor};

/// From one reading to the next, and from one look at the robot to the next, in s.
const READING_S: f64 = 0.005;
const LOOK_S: f64 = 0.01;
/// How long a thread usually waits for the processor at most, and how long one in so many, in s.
const SHORT_WAIT_S: f64 = 0.000_5;
const LONG_WAIT_S: f64 = 0.02;
const LONG_OF: f64 = 1.0 / 64.0;

/// Which thread.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Thread {
    Reader,
    Watcher,
}

/// A reading that waits for whoever asks for it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Heard {
    pub(super) wrench: Wrench,
    pub(super) stamp: Stamp,
    /// How many there were.
    pub(super) count: u64,
}

/// The threads over one supervisor.
pub(super) struct Guard {
    pub(super) supervisor: SharedSupervisor,
    pub(super) cancel: Cancel,
    draws: Draws,
    turns: u64,
    reader_s: f64,
    watcher_s: f64,
    /// Whether the transducer numbers its readings.
    pub(super) is_numbered: bool,
    pub(super) latest: Option<Heard>,
    /// What the robot reported last.
    pub(super) seen: Option<(Pose, Stamp)>,
    /// Whether the robot makes a motion.
    pub(super) is_moving: bool,
}

impl Guard {
    /// Threads that begin at `now_s`; what they wait for is drawn from `draws`.
    pub(super) fn new(
        supervisor: SharedSupervisor,
        cancel: Cancel,
        draws: Draws,
        is_numbered: bool,
        now_s: f64,
    ) -> Guard {
        Guard {
            supervisor,
            cancel,
            draws,
            // Another process draws other waits.
            turns: now_s.to_bits(),
            reader_s: now_s,
            watcher_s: now_s,
            is_numbered,
            latest: None,
            seen: None,
            is_moving: false,
        }
    }

    /// When the next thread has the processor.
    pub(super) fn next_s(&self) -> f64 {
        self.reader_s.min(self.watcher_s)
    }

    /// The thread that has the processor at `now_s`, which is due again after that.
    pub(super) fn due(&mut self, now_s: f64) -> Option<Thread> {
        if self.next_s() > now_s {
            return None;
        }
        self.turns = self.turns.wrapping_add(1);
        let [long, part] = [1, 2].map(|place| self.draws.fraction([self.turns, place]));
        let most_s = if long < LONG_OF {
            LONG_WAIT_S
        } else {
            SHORT_WAIT_S
        };
        let is_reader = self.reader_s <= self.watcher_s;
        let (period_s, thread) = match is_reader {
            true => (READING_S, Thread::Reader),
            false => (LOOK_S, Thread::Watcher),
        };
        let next_s = ((now_s / period_s).floor() + 1.0) * period_s + part * most_s;
        match thread {
            Thread::Reader => self.reader_s = next_s,
            Thread::Watcher => self.watcher_s = next_s,
        }
        Some(thread)
    }
}
