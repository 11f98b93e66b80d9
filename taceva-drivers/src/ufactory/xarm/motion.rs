//! One straight motion of the tip, from the first report until the tip is at rest.

use std::time::Duration;

use taceva_core::{Deadline, DriverError, ErrorKind, Pose, Speed, Stamp};

use super::arm::Arm;
use super::command::{Command, MoveLine};
use super::error::{failed, unanswered};
use super::observe::{ANSWER, Observation, STALE, error_now, state_now};
use super::report::{State, numbers_of, pose_of};
use crate::link::monotonic;

pub(super) const DOING: &str = "move the arm";
/// Greatest distance from the target that counts as arrival, mm: half the repeatability of the best arms of the family.
const NEAR_MM: f64 = 0.05;
/// Time from a command until a ready arm at the target counts as arrived, even if no report showed the motion.
const BEGUN: Duration = Duration::from_millis(50);
/// Time from a command until a ready arm away from the target counts as stopped there.
const NEVER_BEGUN: Duration = Duration::from_millis(1_000);
/// Longest wait until a stopped arm is at rest.
const STOPPING: Duration = Duration::from_millis(400);
/// Longest wait of a motion until the stop connection answers. Reconnecting takes less time.
const STOPPABLE: Duration = Duration::from_secs(2);

/// Error of a motion that did not reach its target.
pub(super) struct BrokenOff {
    error: DriverError,
    /// True if a stop was sent, or the controller stopped by itself.
    is_stopped: bool,
}

impl BrokenOff {
    /// Creates the error of a motion that is already stopped.
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
    /// Moves the tip to `target` and returns once it rests there. An error states why the tip stopped elsewhere.
    pub(super) fn go(
        &mut self,
        target: Pose,
        speed: Speed,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        let began = monotonic();
        self.check_ready(deadline)?;
        if deadline.has_passed() {
            return Err(failed(
                ErrorKind::Timeout,
                DOING,
                "the deadline has already passed",
            ));
        }
        let until = began.saturating_add(deadline.remaining());
        let ended = self.follow(target, speed, until);
        self.end(ended)
    }

    /// Returns the result `ended` of a motion. Stops the arm first if the result is an error.
    pub(super) fn end<T>(&mut self, ended: Result<T, BrokenOff>) -> Result<T, DriverError> {
        let BrokenOff { error, is_stopped } = match ended {
            Ok(done) => return Ok(done),
            Err(broken_off) => broken_off,
        };
        if !is_stopped {
            // The returned error gives the reason. If the stop cannot be sent, the link is broken, which is reported elsewhere.
            let _ = self.stopping().stop();
        }
        self.settle();
        // A timed-out motion is not a halt, so the next one is accepted.
        let given_up = error.kind() == ErrorKind::Timeout;
        if given_up && !self.stopping().is_halted() {
            let _ = self.stand_by(DOING);
        }
        Err(error)
    }

    /// Fails if the arm cannot be stopped, is halted or is not ready.
    pub(super) fn check_ready(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        let patience = STOPPABLE.min(deadline.remaining());
        let is_alive = self.stopping().is_alive_within(patience);
        if self.stopping().is_halted() {
            return Err(halted());
        }
        if !is_alive {
            // The stop connection is silent but still retried.
            let why = "the connection for stops does not answer";
            return Err(failed(ErrorKind::Timeout, DOING, why));
        }
        let fault = self.observer.error(&mut self.exchange);
        if let Some(fault) = fault.map_err(unanswered(DOING))? {
            return Err(fault.met(DOING));
        }
        if self.observer.is_enabled() == Some(false) {
            let why = "its motors are off; enable the arm by hand in UFACTORY Studio";
            return Err(failed(ErrorKind::DeviceFault, DOING, why));
        }
        if let Some(mode) = self.observer.mode().filter(|mode| *mode != 0) {
            let why = format!(
                "the controller is in mode {mode}, expected 0 (position): end the halt, or select mode 0 in UFACTORY Studio"
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
            let now = state_now(&mut self.exchange, ANSWER).map_err(unanswered(DOING))?;
            if !now.is_ready() {
                return Err(self.not_ready(now));
            }
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
                let why = "the tip did not arrive within the deadline";
                return Err(failed(ErrorKind::Timeout, DOING, why).into());
            }
            // Shorter than the deadline: an arm without reports is stopped long before it.
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
                let now = state_now(&mut self.exchange, ANSWER).map_err(unanswered(DOING))?;
                if now.is_stopped() {
                    return Err(self.not_ready(now));
                }
            } else if last.queued == 0 && last.at > sent {
                let short_mm = distance_mm(&last, &target);
                if short_mm <= NEAR_MM && (has_moved || since >= BEGUN) {
                    return Ok(Stamp::at(last.at));
                }
                if since >= NEVER_BEGUN {
                    let why = format!(
                        "the tip came to rest {short_mm:.3} mm from its target, expected at most {NEAR_MM} mm"
                    );
                    return Err(failed(ErrorKind::DeviceFault, DOING, why).into());
                }
            }
        }
    }

    fn line(&self, target: &Pose, speed: Speed) -> Command {
        #[expect(
            clippy::cast_possible_truncation,
            reason = "the protocol sends f32, and both values are far below the maximum of f32"
        )]
        Command::MoveLine(MoveLine {
            pose: numbers_of(target),
            speed_mm_s: speed.mm_per_s() as f32,
            acceleration_mm_s2: self.options.acceleration_mm_s2 as f32,
        })
    }

    /// Error for an arm that does not move, because its controller is in `state`.
    pub(super) fn not_ready(&mut self, state: State) -> BrokenOff {
        let error = if self.stopping().is_halted() {
            halted()
        } else {
            match error_now(&mut self.exchange) {
                Ok(Some(fault)) => fault.met(DOING),
                Ok(None) => {
                    let why = format!(
                        "the controller is {}, because of an earlier halt or another client; end the halt to go on",
                        state.name()
                    );
                    failed(ErrorKind::DeviceFault, DOING, why)
                }
                Err(error) => unanswered(DOING)(error),
            }
        };
        BrokenOff {
            error,
            // A paused controller continues on command, so it is not stopped.
            is_stopped: state.0 > 3,
        }
    }

    /// Waits until a stopped arm is at rest or sends no reports.
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

/// Distance of the tip from `target`, mm; infinite if the report has values that are not finite.
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
