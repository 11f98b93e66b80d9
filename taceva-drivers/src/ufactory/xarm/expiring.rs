//! Motion by velocities that expire. The controller stops the arm unless the driver renews the velocity in time.

use std::time::Duration;

use taceva_core::{Deadline, DriverError, EXPIRES, ErrorKind, ExpiringMotion, Pose, Speed, Stamp};

use super::arm::Arm;
use super::command::{Command, Mode, MoveVelocity};
use super::error::{failed, unanswered};
use super::motion::{BrokenOff, DOING, halted};
use super::observe::{ANSWER, state_now};
use super::report::pose_of;
use crate::link::course::{Course, LINE, RENEWED};
use crate::link::monotonic;

impl ExpiringMotion for Arm {
    fn move_expiring(
        &mut self,
        target: Pose,
        speed: Speed,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        self.admit(&target, speed)?;
        let until = monotonic().saturating_add(deadline.remaining());
        self.check_ready(deadline)?;
        let first = self.observer.observe(&mut self.exchange, None, ANSWER)?;
        if let Some(course) = Course::of(&pose_of(first.pose), &target, speed) {
            let cruised = self.cruise(&course, until);
            self.end(cruised)?;
        }
        let left = until.saturating_sub(monotonic());
        self.go(target, speed, Deadline::after(left))
    }
}

impl Arm {
    /// Follows `course` almost to its end, then stops and sets the position mode.
    fn cruise(&mut self, course: &Course, until: Duration) -> Result<(), BrokenOff> {
        self.take(Mode::Velocity, DOING)?;
        let mut renewed: Option<Duration> = None;
        let mut last = self.observer.observe(&mut self.exchange, None, ANSWER)?;
        while course.left(&pose_of(last.pose)) > LINE {
            if self.stopping().is_halted() {
                return Err(BrokenOff::stopped(halted()));
            }
            let now = monotonic();
            if now >= until {
                let why = "the tip did not arrive within the deadline";
                return Err(failed(ErrorKind::Timeout, DOING, why).into());
            }
            if renewed.is_none_or(|renewed| now.saturating_sub(renewed) >= RENEWED) {
                let reply = self.exchange.ask(velocity(course), ANSWER);
                let reply = reply.map_err(unanswered(DOING))?;
                if reply.status.has_error() || reply.status.is_not_ready() {
                    return Err(self.not_ready(last.state));
                }
                if reply.status.is_invalid() {
                    let why = "the controller does not accept velocities of the tip";
                    return Err(failed(ErrorKind::DeviceFault, DOING, why).into());
                }
                renewed = Some(now);
            }
            last = self
                .observer
                .observe(&mut self.exchange, Some(&last), EXPIRES)?;
            let fault = self.observer.error(&mut self.exchange);
            if let Some(fault) = fault.map_err(unanswered(DOING))? {
                return Err(fault.met(DOING).into());
            }
            if last.state.is_stopped() {
                let now = state_now(&mut self.exchange, ANSWER).map_err(unanswered(DOING))?;
                if now.is_stopped() {
                    return Err(self.not_ready(now));
                }
            }
        }
        if self.stopping().is_halted() {
            return Err(BrokenOff::stopped(halted()));
        }
        // The change of mode stops the motion.
        Ok(self.take(Mode::Position, DOING)?)
    }
}

/// Command to move with the velocity of `course`.
fn velocity(course: &Course) -> Command {
    #[expect(clippy::cast_possible_truncation, reason = "the protocol sends f32")]
    let velocity_mm_s = course.velocity_mm_s().map(|side| side as f32);
    Command::MoveVelocity(MoveVelocity {
        velocity_mm_s,
        duration_s: EXPIRES.as_secs_f32(),
    })
}
