//! Motion by programs that expire. The arm brakes unless the driver sends the next program in time.

use std::time::Duration;

use taceva_core::{Deadline, DriverError, EXPIRES, ErrorKind, ExpiringMotion, Pose, Speed, Stamp};

use super::arm::{Arm, M_A_MM, failed, numbered_pose};
use super::message::ArmState;
use super::motion::{DOING, halted};
use super::safety::ArmFault;
use super::script::cruise;
use crate::link::course::{Course, LINE, RENEWED};
use crate::link::{Seen, monotonic};

impl ExpiringMotion for Arm {
    fn move_expiring(
        &mut self,
        target: Pose,
        speed: Speed,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        self.admit(&target, speed)?;
        let until = monotonic().saturating_add(deadline.remaining());
        let first = self.ready(deadline)?;
        let from = numbered_pose(&first.what, DOING)?;
        let ended = match Course::of(&from, &target, speed) {
            // The line replaces the last velocity; no rest is needed in between.
            Some(course) => self
                .cruise(&course, until, first)
                .and_then(|last| self.follow(target, speed, until, last)),
            None => self.follow(target, speed, until, first),
        };
        self.end(ended)
    }
}

impl Arm {
    /// Follows `course` almost to its end, and returns the last state. The arm still moves then.
    fn cruise(
        &mut self,
        course: &Course,
        until: Duration,
        first: Seen<ArmState>,
    ) -> Result<Seen<ArmState>, DriverError> {
        let program = cruise(
            course.velocity_mm_s().map(|side| side * M_A_MM),
            EXPIRES.as_secs_f64(),
            [
                self.options.acceleration_mm_s2 * M_A_MM,
                self.options.deceleration_mm_s2 * M_A_MM,
            ],
        );
        let mut renewed: Option<Duration> = None;
        let mut last = first;
        while course.left(&numbered_pose(&last.what, DOING)?) > LINE {
            if self.stop.is_halted() {
                return Err(halted());
            }
            let now = monotonic();
            if now >= until {
                let why = "the tip did not arrive within the deadline";
                return Err(failed(ErrorKind::Timeout, DOING, why));
            }
            if renewed.is_none_or(|renewed| now.saturating_sub(renewed) >= RENEWED) {
                let sent = self.motions.send(&program);
                sent.map_err(|error| failed(error.kind(), DOING, error))?;
                renewed = Some(now);
            }
            last = self.look(Some(last.number), EXPIRES)?;
            if let Some(fault) = ArmFault::of(&last.what) {
                return Err(fault.met(DOING));
            }
        }
        Ok(last)
    }
}
