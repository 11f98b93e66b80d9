//! One straight motion of the tool, from the first state until the tool is at rest.

use std::time::Duration;

use taceva_core::{Deadline, DriverError, ErrorKind, Pose, Speed, Stamp};

use super::arm::{Arm, M_A_MM, failed};
use super::message::ArmState;
use super::rotation::{numbers_of, pose_of};
use super::safety::ArmFault;
use super::script::move_line;
use crate::link::{Seen, monotonic};

pub(super) const DOING: &str = "move the arm";
/// Greatest distance from the target that counts as arrival, mm.
const NEAR_MM: f64 = 0.05;
/// Longest time without a state before a moving arm is stopped.
const STALE: Duration = Duration::from_millis(250);
/// Time from a command until an arm at the target counts as arrived, even if no state showed its program.
const BEGUN: Duration = Duration::from_millis(100);
/// Time from a command until an arm that runs no program away from the target counts as stopped there.
const NEVER_BEGUN: Duration = Duration::from_millis(1_000);
/// Time that the arm may take to reach its target after its program has ended.
const SETTLED: Duration = Duration::from_millis(200);
/// Time after which a stop counts as ended, from the first state that shows the stop.
const BRAKED: Duration = Duration::from_millis(400);
/// Longest wait until a stopped arm is at rest.
const STOPPING: Duration = Duration::from_millis(400);
/// Runtime state of a controller that runs no program.
const STOPPED: u32 = 1;

impl Arm {
    /// Moves the tip to `target` and returns once it rests there. An error states why the tip stopped elsewhere.
    pub(super) fn go(
        &mut self,
        target: Pose,
        speed: Speed,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        let until = monotonic().saturating_add(deadline.remaining());
        let first = self.ready(deadline)?;
        let ended = self.follow(target, speed, until, first);
        self.end(ended)
    }

    /// Waits until the arm may be moved, and returns its state.
    pub(super) fn ready(&self, deadline: Deadline) -> Result<Seen<ArmState>, DriverError> {
        let until = monotonic().saturating_add(deadline.remaining());
        if self.stop.is_halted() {
            return Err(halted());
        }
        if !self.stop.is_alive() {
            let why = "the connection for stops is closed";
            return Err(failed(ErrorKind::Disconnected, DOING, why));
        }
        if deadline.has_passed() {
            return Err(failed(
                ErrorKind::Timeout,
                DOING,
                "the deadline has already passed",
            ));
        }
        let first = self.after_every_stop(until)?;
        if first.what.runtime != STOPPED {
            let why = "the controller runs another program, expected none: stop that program";
            return Err(failed(ErrorKind::DeviceFault, DOING, why));
        }
        Ok(first)
    }

    /// Waits until all stops that were sent have ended or count as lost. Returns the first state after that.
    fn after_every_stop(&self, until: Duration) -> Result<Seen<ArmState>, DriverError> {
        let left = || until.saturating_sub(monotonic());
        let mut seen = self.look(None, left())?;
        // Time since which the last stop is known to be executed.
        let mut obeyed = None;
        loop {
            if let Some(fault) = ArmFault::of(&seen.what) {
                return Err(fault.met(DOING));
            }
            if self.stop.is_obeyed(seen.what.stop) {
                let since = *obeyed.get_or_insert(seen.at);
                let has_ended = seen.what.runtime == STOPPED;
                if has_ended || seen.at.saturating_sub(since) >= BRAKED {
                    return Ok(seen);
                }
            }
            if self.stop.is_halted() {
                return Err(halted());
            }
            if left().is_zero() {
                let why = "the controller did not confirm the last stop within the deadline: check the link, then end the halt";
                return Err(failed(ErrorKind::Timeout, DOING, why));
            }
            seen = self.look(Some(seen.number), left())?;
        }
    }

    /// Returns the result `ended` of a motion. Stops the arm first if the result is an error.
    pub(super) fn end(&self, ended: Result<Stamp, DriverError>) -> Result<Stamp, DriverError> {
        if ended.is_err() {
            // Send the stop after the motion on the same connection, since a stop on the other may have overtaken it. If it cannot be sent,
            // the link is broken, which is reported elsewhere.
            let _ = self.motions.send(&self.stop.program());
            let _ = self.stop.send();
            self.settle();
        }
        ended
    }

    /// Replaces the current motion by a line to `target` and returns once the arm rests there.
    pub(super) fn follow(
        &mut self,
        target: Pose,
        speed: Speed,
        until: Duration,
        first: Seen<ArmState>,
    ) -> Result<Stamp, DriverError> {
        let program = move_line(
            numbers_of(target),
            speed.mm_per_s() * M_A_MM,
            self.options.acceleration_mm_s2 * M_A_MM,
        );
        self.motions
            .send(&program)
            .map_err(|error| failed(error.kind(), DOING, error))?;
        let sent = monotonic();
        let mut has_run = false;
        // Time since which no program runs.
        let mut rested = None;
        let mut last = first;
        loop {
            if self.stop.is_halted() {
                return Err(halted());
            }
            if monotonic() >= until {
                let why = "the tip did not arrive within the deadline";
                return Err(failed(ErrorKind::Timeout, DOING, why));
            }
            last = self.look(Some(last.number), STALE)?;
            if let Some(fault) = ArmFault::of(&last.what) {
                return Err(fault.met(DOING));
            }
            let since = last.at.saturating_sub(sent);
            if last.what.runtime != STOPPED {
                (has_run, rested) = (true, None);
                continue;
            }
            let rests = last.at.saturating_sub(*rested.get_or_insert(last.at));
            let short_mm = distance_mm(&last.what, &target);
            if short_mm <= NEAR_MM && (has_run || since >= BEGUN) {
                return Ok(Stamp::at(last.at));
            }
            if has_run && rests >= SETTLED || since >= NEVER_BEGUN {
                let why = format!(
                    "the tip came to rest {short_mm:.3} mm from its target, expected at most {NEAR_MM} mm"
                );
                return Err(failed(ErrorKind::DeviceFault, DOING, why));
            }
        }
    }

    /// Waits until a stopped arm runs no program or sends no state.
    fn settle(&self) {
        let until = monotonic() + STOPPING;
        let mut last = None;
        while monotonic() < until {
            match self.look(last, STALE) {
                Ok(seen) if seen.what.runtime != STOPPED => last = Some(seen.number),
                Ok(seen) if last.is_none() => last = Some(seen.number),
                _ => return,
            }
        }
    }
}

pub(super) fn halted() -> DriverError {
    failed(ErrorKind::Interrupted, DOING, "it was halted")
}

/// Distance of the tip from `target`, mm; infinite if the state has values that are not finite.
fn distance_mm(state: &ArmState, target: &Pose) -> f64 {
    let Some(pose) = pose_of(state.pose) else {
        return f64::INFINITY;
    };
    let [at, to] = [pose.position, target.position];
    let sides = [at.x.0 - to.x.0, at.y.0 - to.y.0, at.z.0 - to.z.0];
    sides.iter().map(|side| side * side).sum::<f64>().sqrt()
}
