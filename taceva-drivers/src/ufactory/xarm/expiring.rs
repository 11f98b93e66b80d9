//! Motion by velocities that expire: the controller stops where none comes any more.

use std::time::Duration;

use taceva_core::{Deadline, DriverError, EXPIRES, ErrorKind, ExpiringMotion, Pose, Speed, Stamp};

use super::arm::Arm;
use super::command::{Command, Mode, MoveVelocity};
use super::error::{failed, unanswered};
use super::motion::{BrokenOff, DOING, halted};
use super::observe::{ANSWER, Observation};
use super::report::{State, pose_of};
use crate::link::monotonic;

/// From one velocity to the next: three in a row may be lost.
const RENEWED: Duration = Duration::from_millis(50);
/// So long before its end the way is left to a straight line, which alone ends where it should.
const LINE: Duration = Duration::from_millis(100);
/// A way that takes no longer is a line from its beginning: to change the mode takes time too.
const WORTH: Duration = Duration::from_millis(300);
/// Turned by less than this, in degrees, a tool is turned as it was told.
const TURNED_DEG: f64 = 0.01;

impl ExpiringMotion for Arm {
    fn move_expiring(
        &mut self,
        target: Pose,
        speed: Speed,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        self.admit(&target, speed)?;
        let until = monotonic().saturating_add(deadline.remaining());
        self.check_ready()?;
        let first = self.observer.observe(&mut self.exchange, None, ANSWER)?;
        if let Some(course) = Course::of(&first, &target, speed) {
            let cruised = self.cruise(&course, until);
            self.end(cruised)?;
        }
        let left = until.saturating_sub(monotonic());
        self.go(target, speed, Deadline::after(left))
    }
}

impl Arm {
    /// Goes along `course` until little of it is left, and stands; the controller takes positions then.
    fn cruise(&mut self, course: &Course, until: Duration) -> Result<(), BrokenOff> {
        self.take(Mode::Velocity, DOING)?;
        let mut renewed: Option<Duration> = None;
        let mut last = self.observer.observe(&mut self.exchange, None, ANSWER)?;
        while course.left(&last) > LINE {
            if self.stopping().is_halted() {
                return Err(BrokenOff::stopped(halted()));
            }
            let now = monotonic();
            if now >= until {
                let why = "it did not arrive within the deadline";
                return Err(failed(ErrorKind::Timeout, DOING, why).into());
            }
            if renewed.is_none_or(|renewed| now.saturating_sub(renewed) >= RENEWED) {
                let reply = self.exchange.ask(course.velocity(), ANSWER);
                let reply = reply.map_err(unanswered(DOING))?;
                if reply.status.has_error() || reply.status.is_not_ready() {
                    return Err(self.not_ready(last.state));
                }
                if reply.status.is_invalid() {
                    let why = "the controller takes no velocities of the tip";
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
            if last.state != State::MOVING && !last.state.is_ready() {
                return Err(self.not_ready(last.state));
            }
        }
        if self.stopping().is_halted() {
            return Err(BrokenOff::stopped(halted()));
        }
        // What moves is stopped by that.
        Ok(self.take(Mode::Position, DOING)?)
    }
}

/// A straight way without turning, in mm and mm/s of the base frame.
struct Course {
    to_mm: [f64; 3],
    velocity_mm_s: [f64; 3],
    speed_mm_s: f64,
}

impl Course {
    /// From where the arm was seen to `target`; `None` of a way that is short or on which the tool turns.
    fn of(seen: &Observation, target: &Pose, speed: Speed) -> Option<Course> {
        let from = pose_of(seen.pose);
        let turns = [
            (from.rotation.x.0, target.rotation.x.0),
            (from.rotation.y.0, target.rotation.y.0),
            (from.rotation.z.0, target.rotation.z.0),
        ];
        let turns = turns.map(|(from, to)| (to - from).rem_euclid(360.0));
        let is_turned = |turn: f64| turn.min(360.0 - turn) > TURNED_DEG;
        let (from_mm, to_mm) = (place(&from), place(target));
        let way_mm = [0, 1, 2].map(|axis| to_mm[axis] - from_mm[axis]);
        let (length_mm, speed_mm_s) = (length(way_mm), speed.mm_per_s());
        let is_short = length_mm <= speed_mm_s * WORTH.as_secs_f64();
        // A pose that is no number has no length.
        if turns.into_iter().any(is_turned) || is_short || !length_mm.is_finite() {
            return None;
        }
        let velocity_mm_s = way_mm.map(|side| side / length_mm * speed_mm_s);
        Some(Course {
            to_mm,
            velocity_mm_s,
            speed_mm_s,
        })
    }

    /// How long the way takes that is left; none behind the end.
    fn left(&self, seen: &Observation) -> Duration {
        let at_mm = place(&pose_of(seen.pose));
        let along = |axis: usize| (self.to_mm[axis] - at_mm[axis]) * self.velocity_mm_s[axis];
        let left_s = (along(0) + along(1) + along(2)) / self.speed_mm_s.powi(2);
        Duration::try_from_secs_f64(left_s.max(0.0)).unwrap_or_default()
    }

    fn velocity(&self) -> Command {
        #[expect(
            clippy::cast_possible_truncation,
            reason = "the controller takes no finer numbers"
        )]
        let velocity_mm_s = self.velocity_mm_s.map(|side| side as f32);
        Command::MoveVelocity(MoveVelocity {
            velocity_mm_s,
            duration_s: EXPIRES.as_secs_f32(),
        })
    }
}

fn place(pose: &Pose) -> [f64; 3] {
    [pose.position.x.0, pose.position.y.0, pose.position.z.0]
}

fn length([x, y, z]: [f64; 3]) -> f64 {
    x.hypot(y).hypot(z)
}
