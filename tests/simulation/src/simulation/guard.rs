//! Monitoring threads as events in simulated time: one reads the transducer, the other reads the robot and receives requests to stop.
//!
//! Each thread is due at fixed times. The delay until it gets the processor is random. Its observations therefore reach the supervisor between any
//! two calls of the run and during its motions. While the run uses the supervisor, the threads wait.

use taceva_core::{Pose, Stamp, Wrench};

use super::draws::Draws;
use taceva_protocol::{Cancel, SharedSupervisor};

/// Interval between readings of the transducer, s. The robot is read every [`LOOK_S`], s.
const READING_S: f64 = 0.005;
const LOOK_S: f64 = 0.01;
/// Longest wait of a thread for the processor in usual turns, s; [`LONG_WAIT_S`] in the others.
const SHORT_WAIT_S: f64 = 0.000_5;
const LONG_WAIT_S: f64 = 0.02;
/// Share of turns with a wait of up to [`LONG_WAIT_S`].
const LONG_OF: f64 = 1.0 / 64.0;

/// Monitoring thread: the reader reads the transducer, and the watcher reads the robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Thread {
    Reader,
    Watcher,
}

/// Reading that the run has not yet taken.
#[derive(Clone, Copy, Debug)]
pub(super) struct Heard {
    pub(super) wrench: Wrench,
    pub(super) stamp: Stamp,
    /// Number of readings so far.
    pub(super) count: u64,
}

/// Monitoring threads of one supervisor.
pub(super) struct Guard {
    pub(super) supervisor: SharedSupervisor,
    pub(super) cancel: Cancel,
    draws: Draws,
    turns: u64,
    reader_s: f64,
    watcher_s: f64,
    /// True if the transducer numbers its readings.
    pub(super) is_numbered: bool,
    pub(super) latest: Option<Heard>,
    /// Last report of the robot.
    pub(super) seen: Option<(Pose, Stamp)>,
    /// True while the robot moves.
    pub(super) is_moving: bool,
}

impl Guard {
    /// Creates the threads, which begin at `now_s`, s. Their waits are drawn from `draws`.
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
            // A new process draws other waits.
            turns: now_s.to_bits(),
            reader_s: now_s,
            watcher_s: now_s,
            is_numbered,
            latest: None,
            seen: None,
            is_moving: false,
        }
    }

    /// Time of the next turn of any thread, s.
    pub(super) fn next_s(&self) -> f64 {
        self.reader_s.min(self.watcher_s)
    }

    /// Returns the thread whose turn is due at `now_s`, and schedules its next turn. `None` if no turn is due.
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
