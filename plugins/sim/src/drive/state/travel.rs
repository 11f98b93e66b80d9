//! Motions of the tip along straight lines.

use std::time::Duration;

use taceva_core::{Millimetre, Pose};

use super::{State, coordinates};
use crate::drive::ticks::Ticks;

/// Outcome of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::drive) enum Ended {
    /// The tip reached its target.
    Arrived,
    /// The deadline passed.
    OutOfTime,
    /// The robot was halted.
    Halted,
    /// The force reached the limit of the motion.
    Guarded,
}

/// Settings of a motion.
pub(in crate::drive) struct Motion<'a> {
    pub(in crate::drive) target: Pose,
    pub(in crate::drive) speed_mm_per_s: f64,
    pub(in crate::drive) patience: Duration,
    pub(in crate::drive) is_halted: &'a dyn Fn() -> bool,
    pub(in crate::drive) guard_n: Option<f64>,
}

/// Length of a step of the tip, mm.
pub(super) const STEP_MM: f64 = 0.05;

impl State {
    /// Moves the tip along a straight line.
    pub(in crate::drive) fn travel(&mut self, motion: &Motion<'_>) -> Ended {
        self.stand();
        let (from, sent) = (self.tip_mm, coordinates(&self.sent));
        let target = coordinates(&motion.target);
        let error = self.visit.errors.position_mm;
        let to: [f64; 3] = std::array::from_fn(|axis| target[axis] + error[axis]);
        let length = distance(from, to);
        let steps = (length / STEP_MM).ceil().max(1.0);
        let step_s = length / steps / motion.speed_mm_per_s;
        let (start, mut last) = (self.now, Ticks::default());
        let patience = Ticks::of(motion.patience);
        let mut done = 0.0;
        let mut ended = Ended::Arrived;
        while done < steps {
            if (motion.is_halted)() {
                ended = Ended::Halted;
                break;
            }
            // Time counts from the start of the motion, so rounding errors do not accumulate.
            let then = Ticks::of(Duration::from_secs_f64((done + 1.0) * step_s));
            if then > patience {
                ended = Ended::OutOfTime;
                break;
            }
            done += 1.0;
            // The tip ends exactly at its target, for any start.
            self.tip_mm = if done < steps {
                mix(from, to, done / steps)
            } else {
                to
            };
            self.now = start.after(then);
            self.follow(then.since(last).seconds());
            last = then;
            let reached = |guard: f64| size(self.force_n()) >= guard;
            if motion.guard_n.is_some_and(reached) {
                ended = Ended::Guarded;
                break;
            }
        }
        self.sent = if ended == Ended::Arrived {
            motion.target
        } else {
            let [x, y, z] = mix(sent, target, done / steps).map(Millimetre);
            let mut stopped = self.sent;
            (stopped.position.x, stopped.position.y, stopped.position.z) = (x, y, z);
            stopped.on_grid()
        };
        self.arrive();
        ended
    }
}

pub(super) fn mix(from: [f64; 3], to: [f64; 3], share: f64) -> [f64; 3] {
    std::array::from_fn(|axis| from[axis] + (to[axis] - from[axis]) * share)
}

pub(super) fn distance(from: [f64; 3], to: [f64; 3]) -> f64 {
    size(std::array::from_fn(|axis| to[axis] - from[axis]))
}

fn size(vector: [f64; 3]) -> f64 {
    vector.iter().map(|side| side * side).sum::<f64>().sqrt()
}
