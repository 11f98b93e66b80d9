//! One straight motion, from the first status to rest.

use std::time::Duration;

use taceva_core::{Deadline, DriverError, ErrorKind, Pose, Speed, Stamp};

use super::KEY;
use super::line::State;
use super::machine::{ANSWER, HOLD, Machine, alarm, failed};
use crate::gcode::limits::{MOVE, short_mm, straight};
use crate::link::monotonic;

/// Maximum distance from the target at the end of a motion, mm. A step of most machines is at most 0.01 mm.
const NEAR_MM: f64 = 0.02;
/// Maximum time from sending a motion command to the start of the motion.
const BEGUN: Duration = Duration::from_millis(100);
/// Interval of status queries during a motion; the machine supports no higher rate.
const LOOK_EVERY: Duration = Duration::from_millis(20);

impl Machine {
    /// Moves the tip to `target` and returns once it rests there. An error states why the tip stopped elsewhere.
    pub(super) fn go(
        &mut self,
        target: Pose,
        speed: Speed,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        let until = monotonic().saturating_add(deadline.remaining());
        if self.stop.is_halted() {
            return Err(self.stop.halted());
        }
        if deadline.has_passed() {
            return Err(failed(
                ErrorKind::Timeout,
                MOVE,
                "the deadline has already passed",
            ));
        }
        match self.look(ANSWER)?.what.state {
            // A person has ended any earlier alarm.
            State::Idle => self.link.forget(),
            State::Alarm => return Err(alarm(MOVE)),
            state => {
                let why = format!("its state is {state:?}, expected Idle: end the halt to go on");
                return Err(failed(ErrorKind::DeviceFault, MOVE, why));
            }
        }
        let ended = self.follow(&target, speed, until);
        if let Err(error) = &ended {
            // A second hold is harmless. If it cannot be sent, the link is broken, which is reported elsewhere.
            let _ = self.link.writer().send(HOLD);
            // A timed-out motion is not a halt, so the next one is accepted. Only the caller of a halt ends that halt.
            let given_up = error.kind() == ErrorKind::Timeout;
            let _ = match given_up && !self.stop.is_halted() {
                true => self.empty(MOVE),
                false => self.rest(),
            };
        }
        ended
    }

    fn follow(
        &mut self,
        target: &Pose,
        speed: Speed,
        until: Duration,
    ) -> Result<Stamp, DriverError> {
        // In mm and mm/min, in the machine's frame.
        let line = format!("G21 G90 G94 G53 {}", straight(&target.position, speed));
        self.link
            .command(&line, ANSWER, drop)
            .map_err(|error| error.met(&KEY, MOVE))?;
        let sent = monotonic();
        loop {
            if self.stop.is_halted() {
                return Err(self.stop.halted());
            }
            if monotonic() >= until {
                let why = "the tip did not arrive within the deadline";
                return Err(failed(ErrorKind::Timeout, MOVE, why));
            }
            let seen = self.look(ANSWER)?;
            match seen.what.state {
                State::Running => {}
                State::Idle => {
                    let short_mm = short_mm(seen.what.place_mm, &target.position);
                    if short_mm <= NEAR_MM {
                        return Ok(Stamp::at(seen.at));
                    }
                    if seen.at.saturating_sub(sent) >= BEGUN && !self.stop.is_halted() {
                        let why = format!(
                            "the tip came to rest {short_mm:.3} mm from its target, expected at most {NEAR_MM} mm"
                        );
                        return Err(failed(ErrorKind::DeviceFault, MOVE, why));
                    }
                }
                State::Alarm => return Err(alarm(MOVE)),
                state if !self.stop.is_halted() => {
                    let why = format!(
                        "a person or another program stopped the machine, which is in state {state:?}"
                    );
                    return Err(failed(ErrorKind::DeviceFault, MOVE, why));
                }
                _ => {}
            }
            std::thread::sleep(LOOK_EVERY);
        }
    }

    /// Waits until a halted machine is at rest, at most 0.5 s.
    fn rest(&mut self) -> Result<(), DriverError> {
        let until = monotonic() + ANSWER;
        while monotonic() < until {
            let state = self.look(ANSWER)?.what.state;
            if !matches!(state, State::Running | State::Slowing) {
                break;
            }
        }
        Ok(())
    }
}
