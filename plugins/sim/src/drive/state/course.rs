//! Motion in progress, for benches on wall-clock time.

use std::time::Duration;

use taceva_core::{Millimetre, Pose};

use super::travel::{STEP_MM, distance, mix};
use super::{State, coordinates};
use crate::drive::ticks::Ticks;

/// A straight motion of the tip.
#[derive(Clone, Copy, Debug)]
pub(super) struct Course {
    /// Start of the motion of the tip, in mm; the next field is the end.
    from_mm: [f64; 3],
    to_mm: [f64; 3],
    /// Reported position at the start, in mm.
    sent_mm: [f64; 3],
    target: Pose,
    speed_mm_per_s: f64,
    /// Distance travelled, in mm.
    done_mm: f64,
}

impl Course {
    fn length_mm(&self) -> f64 {
        distance(self.from_mm, self.to_mm)
    }

    fn share(&self) -> f64 {
        let length_mm = self.length_mm();
        if length_mm > 0.0 {
            self.done_mm / length_mm
        } else {
            1.0
        }
    }
}

impl State {
    /// Begins a straight motion that [`advance`](State::advance) executes. Stops a motion in progress at its present place.
    pub(in crate::drive) fn set_out(&mut self, target: Pose, speed_mm_per_s: f64) {
        self.stand();
        let error_mm = self.visit.errors.position_mm;
        let end_mm = coordinates(&target);
        self.course = Some(Course {
            from_mm: self.tip_mm,
            to_mm: std::array::from_fn(|axis| end_mm[axis] + error_mm[axis]),
            sent_mm: coordinates(&self.sent),
            target,
            speed_mm_per_s,
            done_mm: 0.0,
        });
    }

    /// Stops a motion in progress at the current place.
    pub(in crate::drive) fn stand(&mut self) {
        if let Some(course) = self.course.take() {
            self.believe(&course);
            self.arrive();
        }
    }

    pub(in crate::drive) fn is_moving(&self) -> bool {
        self.course.is_some()
    }

    /// Advances the clock to `until` and the tip along its motion. A time in the past has no effect.
    pub(in crate::drive) fn advance(&mut self, until: Duration) {
        let until = Ticks::of(until);
        while until > self.now {
            let left_s = until.since(self.now).seconds();
            let Some(mut course) = self.course else {
                self.rest(until.since(self.now).duration());
                return;
            };
            let to_go_mm = course.length_mm() - course.done_mm;
            let step_mm = to_go_mm.min(STEP_MM).min(left_s * course.speed_mm_per_s);
            let step_s = step_mm / course.speed_mm_per_s;
            // A step below one nanosecond ends the motion, or the remaining time.
            let then = self.now.after(Ticks::of(Duration::from_secs_f64(step_s)));
            course.done_mm += step_mm;
            let is_there = step_mm >= to_go_mm;
            let step = then.min(until).since(self.now);
            self.now = self.now.after(step);
            self.tip_mm = match is_there {
                // The tip ends exactly at its target, for any start.
                true => course.to_mm,
                false => mix(course.from_mm, course.to_mm, course.share()),
            };
            self.follow(step.seconds());
            if is_there {
                self.course = None;
                self.sent = course.target;
                self.arrive();
            } else {
                self.course = Some(course);
                self.believe(&course);
                if step == Ticks::default() {
                    self.now = until;
                }
            }
        }
    }

    /// Updates the reported pose by the progress of the motion.
    fn believe(&mut self, course: &Course) {
        let target_mm = coordinates(&course.target);
        let [x, y, z] = mix(course.sent_mm, target_mm, course.share()).map(Millimetre);
        let position = &mut self.sent.position;
        (position.x, position.y, position.z) = (x, y, z);
        self.sent = self.sent.on_grid();
    }
}
