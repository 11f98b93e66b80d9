//! One straight motion, from the look before it to the rest after it.

use std::time::Duration;

use taceva_core::{Deadline, DriverError, ErrorKind, Pose, Speed, Stamp};

use super::arm::Arm;
use super::command::{Command, MoveLine};
use super::error::{failed, unanswered};
use super::observe::{ANSWER, Observation, STALE, error_now};
use super::report::{State, numbers_of, pose_of};
use crate::link::monotonic;

pub(super) const DOING: &str = "move the arm";
/// How near the target a motion ends: half of what the best arms of the family repeat.
const NEAR_MM: f64 = 0.05;
/// After this time a controller that stands by at the target has not still to begin.
const BEGUN: Duration = Duration::from_millis(50);
/// After this time a controller that stands by elsewhere will not begin any more.
const NEVER_BEGUN: Duration = Duration::from_millis(1_000);
/// How long an arm that was asked to stop is looked at until it stands.
const STOPPING: Duration = Duration::from_millis(400);
/// How long a motion waits for the connection by which it would be stopped: one that fell silent is made anew in less.
const STOPPABLE: Duration = Duration::from_secs(2);

/// Why a motion did not end at its target.
pub(super) struct BrokenOff {
    error: DriverError,
    /// Whether the controller has been asked to stop already, or has stopped by itself.
    is_stopped: bool,
}

impl BrokenOff {
    /// For what stopped the controller already.
    pub(super) fn stopped(error: DriverError) -> BrokenOff {
        BrokenOff {
            error,
            is_stopped: true,
        }
    }
}

impl From<DriverError> for BrokenOff {
    fn from(error: DriverError) -> BrokenOff {
        BrokenOff {
            error,
            is_stopped: false,
        }
    }
}

impl Arm {
    /// Moves the tip to `target` and returns once it rests there, or stands elsewhere and why.
    pub(super) fn go(
        &mut self,
        target: Pose,
        speed: Speed,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        let began = monotonic();
        self.check_ready(deadline)?;
        if deadline.has_passed() {
            return Err(failed(ErrorKind::Timeout, DOING, "no time to move at all"));
        }
        let until = began.saturating_add(deadline.remaining());
        let ended = self.follow(target, speed, until);
        self.end(ended)
    }

    /// Ends a motion: one that was broken off is stopped.
    pub(super) fn end<T>(&mut self, ended: Result<T, BrokenOff>) -> Result<T, DriverError> {
        let BrokenOff { error, is_stopped } = match ended {
            Ok(done) => return Ok(done),
            Err(broken_off) => broken_off,
        };
        if !is_stopped {
            // The error that is returned says why; a stop that could not be sent says so by a link that is gone.
            let _ = self.stopping().stop();
        }
        self.settle();
        // A motion that was given up is no halt: the next one is accepted.
        let given_up = error.kind() == ErrorKind::Timeout;
        if given_up && !self.stopping().is_halted() {
            let _ = self.stand_by(DOING);
        }
        Err(error)
    }

    /// Refuses to begin where the arm could not be stopped, is halted or is not ready.
    pub(super) fn check_ready(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        let patience = STOPPABLE.min(deadline.remaining());
        let is_alive = self.stopping().is_alive_within(patience);
        if self.stopping().is_halted() {
            return Err(halted());
        }
        if !is_alive {
            // It is tried until it does: what the arm would be stopped by is silent, and not yet gone.
            let why = "the connection by which it would be stopped does not answer";
            return Err(failed(ErrorKind::Timeout, DOING, why));
        }
        let fault = self.observer.error(&mut self.exchange);
        if let Some(fault) = fault.map_err(unanswered(DOING))? {
            return Err(fault.met(DOING));
        }
        if self.observer.is_enabled() == Some(false) {
            let why = "its motors are off; enable the arm in UFACTORY Studio, which this program never does";
            return Err(failed(ErrorKind::DeviceFault, DOING, why));
        }
        if let Some(mode) = self.observer.mode().filter(|mode| *mode != 0) {
            let why = format!(
                "the controller is in mode {mode}, expected 0, position: end the halt, or choose it in UFACTORY Studio"
            );
            return Err(failed(ErrorKind::DeviceFault, DOING, why));
        }
        Ok(())
    }

    fn follow(&mut self, target: Pose, speed: Speed, until: Duration) -> Result<Stamp, BrokenOff> {
        let patience = until.saturating_sub(monotonic());
        let mut last = self
            .observer
            .observe(&mut self.exchange, None, patience.max(ANSWER))?;
        if !last.state.is_ready() {
            return Err(self.not_ready(last.state));
        }
        let reply = self
            .exchange
            .ask(self.line(&target, speed), ANSWER)
            .map_err(unanswered(DOING))?;
        if reply.status.has_error() || reply.status.is_not_ready() {
            return Err(self.not_ready(last.state));
        }
        let sent = monotonic();
        let mut has_moved = false;
        loop {
            if self.stopping().is_halted() {
                return Err(BrokenOff::stopped(halted()));
            }
            let left = until.saturating_sub(monotonic());
            if left.is_zero() {
                let why = "it did not arrive within the deadline";
                return Err(failed(ErrorKind::Timeout, DOING, why).into());
            }
            // Not the time that is left: an arm that is not seen is stopped long before that.
            last = self
                .observer
                .observe(&mut self.exchange, Some(&last), STALE)?;
            let fault = self.observer.error(&mut self.exchange);
            if let Some(fault) = fault.map_err(unanswered(DOING))? {
                return Err(fault.met(DOING).into());
            }
            let since = last.at.saturating_sub(sent);
            if last.state == State::MOVING {
                has_moved = true;
            } else if !last.state.is_ready() {
                return Err(self.not_ready(last.state));
            } else if last.queued == 0 && last.at > sent {
                let short_mm = distance_mm(&last, &target);
                if short_mm <= NEAR_MM && (has_moved || since >= BEGUN) {
                    return Ok(Stamp::at(last.at));
                }
                if since >= NEVER_BEGUN {
                    let why = format!(
                        "it came to rest {short_mm:.3} mm from its target, expected at most {NEAR_MM} mm"
                    );
                    return Err(failed(ErrorKind::DeviceFault, DOING, why).into());
                }
            }
        }
    }

    fn line(&self, target: &Pose, speed: Speed) -> Command {
        #[expect(
            clippy::cast_possible_truncation,
            reason = "the controller takes no finer numbers; both are far below its greatest"
        )]
        Command::MoveLine(MoveLine {
            pose: numbers_of(target),
            speed_mm_s: speed.mm_per_s() as f32,
            acceleration_mm_s2: self.options.acceleration_mm_s2 as f32,
        })
    }

    /// Why a controller in `state` does not move.
    pub(super) fn not_ready(&mut self, state: State) -> BrokenOff {
        let error = if self.stopping().is_halted() {
            halted()
        } else {
            match error_now(&mut self.exchange) {
                Ok(Some(fault)) => fault.met(DOING),
                Ok(None) => {
                    let why = format!(
                        "the controller is {}, by somebody else or by an earlier halt; end the halt to go on",
                        state.name()
                    );
                    failed(ErrorKind::DeviceFault, DOING, why)
                }
                Err(error) => unanswered(DOING)(error),
            }
        };
        BrokenOff {
            error,
            // Paused, it would go on as soon as somebody says so.
            is_stopped: state.0 > 3,
        }
    }

    /// Waits until an arm that was stopped stands, or cannot be seen.
    fn settle(&mut self) {
        let until = monotonic() + STOPPING;
        let mut last: Option<Observation> = None;
        while monotonic() < until {
            match self
                .observer
                .observe(&mut self.exchange, last.as_ref(), STALE)
            {
                Ok(seen) if [State::MOVING, State::SLOWING_DOWN].contains(&seen.state) => {
                    last = Some(seen);
                }
                _ => return,
            }
        }
    }
}

pub(super) fn halted() -> DriverError {
    failed(ErrorKind::Interrupted, DOING, "it was halted")
}

/// How far the tip is from `target`; infinite where the report has no numbers.
fn distance_mm(seen: &Observation, target: &Pose) -> f64 {
    let [at, to] = [pose_of(seen.pose).position, target.position];
    let sides = [at.x.0 - to.x.0, at.y.0 - to.y.0, at.z.0 - to.z.0];
    let distance_mm = sides.iter().map(|side| side * side).sum::<f64>().sqrt();
    if distance_mm.is_finite() {
        distance_mm
    } else {
        f64::INFINITY
    }
}
