//! One straight motion, from the first command to rest.

use std::time::Duration;

use taceva_core::{Deadline, DriverError, ErrorKind, Pose, Speed, Stamp};

use super::KEY;
use super::machine::{ANSWER, Printer, QUICK_STOP};
use crate::gcode::limits::{MOVE, short_mm, straight};
use crate::gcode::link::{Answer, CommandError};
use crate::link::monotonic;

/// Maximum distance from the target at the end of a motion, mm. Printers report positions to 0.01 mm.
const NEAR_MM: f64 = 0.02;
/// Interval at which a motion checks for a halt.
const LOOK_EVERY: Duration = Duration::from_millis(10);
/// Maximum time without output from the printer. A busy printer reports every two seconds.
const SILENT: Duration = Duration::from_secs(5);
/// Timeout for answers after a stop.
const SETTLED: Duration = Duration::from_secs(3);
/// Command that waits for the end of the motion.
const WAIT: &str = "M400";

fn failed(kind: ErrorKind, why: String) -> DriverError {
    DriverError::new(kind, &KEY, MOVE).because(why)
}

impl Printer {
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
                "the deadline has already passed".to_owned(),
            ));
        }
        let ended = self.follow(&target, speed, until);
        if ended.is_err() {
            // A second stop is harmless. If it cannot be sent, the link is broken, which is reported elsewhere.
            let _ = self.link.writer().send(QUICK_STOP);
            // A timed-out motion is not a halt, so the next one is accepted once answers to this one are skipped.
            let _ = self.agree(SETTLED);
        }
        ended
    }

    fn follow(
        &mut self,
        target: &Pose,
        speed: Speed,
        until: Duration,
    ) -> Result<Stamp, DriverError> {
        let refused = |error: CommandError| error.met(&KEY, MOVE);
        // In mm and mm/min, in the printer's frame.
        for command in ["G21", "G90", &straight(&target.position, speed)] {
            self.order(command)?;
        }
        let lines = self.marked(&format!("{WAIT}\n"));
        self.link.send(&lines).map_err(refused)?;
        let mut heard = monotonic();
        // A wait that is lost on the cable has no `ok` before the echo.
        let (mut is_answered, mut is_marked) = (false, false);
        loop {
            if self.stop.is_halted() {
                return Err(self.stop.halted());
            }
            let now = monotonic();
            if now >= until {
                let why = "the tip did not arrive within the deadline".to_owned();
                return Err(failed(ErrorKind::Timeout, why));
            }
            let answer = self.link.answer(LOOK_EVERY);
            match answer {
                Some(Answer::Mark(mark)) if mark == self.mark && is_answered => is_marked = true,
                Some(Answer::Ok) if is_marked => break,
                Some(Answer::Ok) => (is_answered, heard) = (true, now),
                Some(Answer::Fault(why)) => return Err(refused(CommandError::Fault(why))),
                Some(Answer::Refused(why)) => {
                    let command = WAIT.to_owned();
                    return Err(refused(CommandError::Refused { command, why }));
                }
                Some(_) => heard = now,
                None if now.saturating_sub(heard) >= SILENT => {
                    let why = format!("the printer has sent nothing for {SILENT:?}");
                    return Err(failed(ErrorKind::Timeout, why));
                }
                None => {}
            }
        }
        let rests = self.look(ANSWER)?;
        if self.stop.is_halted() {
            return Err(self.stop.halted());
        }
        let short_mm = short_mm(rests.what, &target.position);
        // NaN fails too.
        if short_mm.is_nan() || short_mm > NEAR_MM {
            let why = format!(
                "the tip came to rest {short_mm:.3} mm from its target, expected at most {NEAR_MM} mm"
            );
            return Err(failed(ErrorKind::DeviceFault, why));
        }
        Ok(Stamp::at(rests.at))
    }
}
