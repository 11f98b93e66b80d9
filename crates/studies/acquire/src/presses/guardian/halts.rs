//! Halts of a robot in motion: the duration of the driver's call, and the time until the tip rests.

use std::cell::OnceCell;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use taceva_core::{DriverError, Halt, Pose, Stamp};
use taceva_drivers::MonotonicClock;

use super::causes::Cause;
use super::thread_facts::{ProcessorQueue, ThreadTimes};

/// Longest duration of a driver's halt call that counts as in time, s.
const CALL_S: f64 = 0.02;
/// Longest time from the decision to halt until the tip rests, s. Every driver promises to stop within this time.
const REST_S: f64 = 0.05;
/// Time after the decision to halt during which poses are read, s.
const FOLLOWED_S: f64 = 0.2;
/// Greatest distance between two reported poses of a tip at rest, mm. If the noise of a pose is greater, the noise is used.
const RESTS_MM: f64 = 1e-3;

thread_local! {
    /// Reader of the processor times of the halting thread. Its file is opened before a halt, because a halt must not wait for the file system.
    static TIMES: OnceCell<ProcessorQueue> = const { OnceCell::new() };
}

/// Opens the file with the processor times of the calling thread, so that a late halt of this thread can state a cause.
pub(super) fn prepare_this_thread() {
    // While a thread ends, its times are no longer accessible.
    let _ = TIMES.try_with(|times| {
        times.get_or_init(ProcessorQueue::of_this_thread);
    });
}

/// Times of one call of a driver's halt function.
#[derive(Clone, Copy, Debug)]
pub(super) struct HaltCall {
    pub(super) decided_s: f64,
    pub(super) returned_s: f64,
    /// Processor times of the thread during the call; `None` if the kernel does not state them.
    pub(super) spent: Option<ThreadTimes>,
}

/// Halt of a motion, with the known facts about its end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Halted {
    pub(super) call: HaltCall,
    /// Time from the decision to halt until the first report of a tip at rest, s; `None` if no report showed it.
    pub(super) rest_s: Option<f64>,
    /// Time from the decision to halt until the last report after which the tip still moved, s; 0 without such a report.
    pub(super) moved_s: f64,
}

/// Times of the first halt call since the guard thread last read them, if any.
#[derive(Debug, Default)]
pub(super) struct HaltCalls(Mutex<Option<HaltCall>>);

/// Wrapper that halts a robot and records the times of the call.
pub(super) struct TimedHalt {
    robot: Arc<dyn Halt>,
    calls: Arc<HaltCalls>,
}

/// State of the robot with respect to halts.
#[derive(Clone, Copy, Debug)]
pub(super) enum Held {
    /// The robot is free to move.
    No,
    /// A halt holds the robot at an unknown pose.
    Unseen,
    /// A halt holds the robot at this pose, reported with this stamp.
    At(Pose, Stamp),
}

/// Follows the poses of a robot after a halt until the tip rests.
#[derive(Debug, Default)]
pub(super) struct HaltFollower {
    /// Noise of a pose at rest, mm.
    slack_mm: f64,
    call: Option<HaltCall>,
    /// Last pose after the decision to halt, and its time in s; `None` before this pose.
    seen: Option<(Pose, f64)>,
    moved_s: f64,
    /// True from the first halt until the robot may move again, or its motion ends. Until then, further halts are repetitions of the first.
    is_repeated: bool,
    /// True if the robot was held in the last turn of the guard thread.
    was_held: bool,
}

impl HaltCalls {
    fn lock(&self) -> MutexGuard<'_, Option<HaltCall>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(super) fn take(&self) -> Option<HaltCall> {
        self.lock().take()
    }
}

impl TimedHalt {
    pub(super) fn new(robot: Arc<dyn Halt>, calls: Arc<HaltCalls>) -> TimedHalt {
        TimedHalt { robot, calls }
    }
}

impl Halt for TimedHalt {
    fn halt(&self) -> Result<(), DriverError> {
        let decided_s = MonotonicClock.now_s();
        let before = times_of_this_thread();
        let halted = self.robot.halt();
        let after = times_of_this_thread();
        let call = HaltCall {
            decided_s,
            returned_s: MonotonicClock.now_s(),
            spent: after
                .zip(before)
                .map(|(after, before)| after.since(&before)),
        };
        self.calls.lock().get_or_insert(call);
        halted
    }
}

fn times_of_this_thread() -> Option<ThreadTimes> {
    let times = TIMES.try_with(|times| times.get()?.times());
    times.ok().flatten()
}

impl HaltCall {
    pub(super) fn took_s(&self) -> f64 {
        self.returned_s - self.decided_s
    }

    /// Cause of the delay of a halt call; `None` for a call in time.
    fn late(&self) -> Option<Cause> {
        let took_s = self.took_s();
        (took_s > CALL_S).then(|| match self.spent {
            Some(spent) if spent.queued_s >= took_s / 2.0 => Cause::Kernel,
            Some(spent) if spent.ran_s >= took_s / 2.0 => Cause::Program,
            Some(_) => Cause::Device,
            None => Cause::Unknown,
        })
    }
}

impl Halted {
    /// Cause of the delay of a halt; `None` for a halt in time. If the call was in time, but the tip moved on, the device is the cause.
    pub(super) fn late(&self) -> Option<Cause> {
        let moved_on = self.moved_on().then_some(Cause::Device);
        self.call.late().or(moved_on)
    }

    /// True if reports show that the tip still moved after `REST_S`. A late report of rest alone is no evidence, because it may have been read late.
    pub(super) fn moved_on(&self) -> bool {
        self.moved_s > REST_S
    }
}

impl HaltFollower {
    /// Creates a follower for a robot whose poses have the noise `slack_mm`, mm, at rest.
    pub(super) fn new(slack_mm: f64) -> HaltFollower {
        HaltFollower {
            slack_mm,
            ..HaltFollower::default()
        }
    }

    /// Processes one turn of the guard thread. `call` is a halt since the last turn, and `is_under_way` states that the robot moves. Returns a halt
    /// when the tip rests, the robot may move again, or `FOLLOWED_S` has passed.
    pub(super) fn turn(
        &mut self,
        call: Option<HaltCall>,
        is_under_way: bool,
        held: Held,
        now_s: f64,
    ) -> Option<Halted> {
        if let Some(call) = call.filter(|_| is_under_way && !self.is_repeated) {
            (self.call, self.seen, self.moved_s) = (Some(call), None, 0.0);
        }
        let is_held = !matches!(held, Held::No);
        let is_same_halt = is_held || (is_under_way && !self.was_held);
        self.is_repeated = is_same_halt && (self.is_repeated || call.is_some());
        self.was_held = is_held;
        let call = self.call?;
        let rest_s = match held {
            Held::At(pose, stamp) if stamp.valid_s > call.decided_s => {
                self.rest_s(&pose, stamp.valid_s, call.decided_s)
            }
            _ => None,
        };
        let is_over = rest_s.is_some() || !is_held || now_s - call.decided_s > FOLLOWED_S;
        is_over.then(|| {
            self.call = None;
            Halted {
                call,
                rest_s,
                moved_s: self.moved_s,
            }
        })
    }

    /// Time from the decision to halt until the tip rested, s: the time of the previous report, if the tip has not moved since. `None` otherwise.
    fn rest_s(&mut self, pose: &Pose, valid_s: f64, decided_s: f64) -> Option<f64> {
        if let Some((seen, seen_s)) = self.seen {
            if valid_s <= seen_s {
                return None;
            }
            if distance_mm(&seen, pose) <= self.slack_mm.max(RESTS_MM) {
                return Some(seen_s - decided_s);
            }
            self.moved_s = seen_s - decided_s;
        }
        self.seen = Some((*pose, valid_s));
        None
    }
}

fn distance_mm(one: &Pose, other: &Pose) -> f64 {
    let [one, other] = [one, other].map(|pose| pose.position);
    let flat_mm = (one.x.0 - other.x.0).hypot(one.y.0 - other.y.0);
    flat_mm.hypot(one.z.0 - other.z.0)
}

#[cfg(test)]
mod tests;
