//! The machine as a robot.

use std::sync::Arc;
use std::time::Duration;

use taceva_core::{
    Deadline, DriverError, ErrorKind, Halt, Millimetre, Point, Pose, Robot, Speed, Stamp,
    check_pose,
};

use super::KEY;
use super::line::{State, Status, read};
use crate::gcode::limits::SerialOptions;
use crate::gcode::link::SerialLink;
use crate::gcode::stop::Stop;
use crate::link::{Seen, monotonic};

/// A machine that is connected.
#[derive(Debug)]
pub(super) struct Machine {
    pub(super) link: SerialLink<Status>,
    pub(super) stop: Arc<Stop>,
    options: SerialOptions,
}

/// Bytes that the machine takes at once.
const ASK_STATUS: &[u8] = b"?";
pub(super) const HOLD: &[u8] = b"!";
const RESET: &[u8] = &[0x18];

/// An error of the machine with its reason.
pub(super) fn failed(
    kind: ErrorKind,
    doing: &'static str,
    why: impl Into<Box<dyn std::error::Error + Send + Sync>>,
) -> DriverError {
    DriverError::new(kind, &KEY, doing).because(why)
}

/// How long a machine may take after its line was opened, which resets many, until it answers.
const AWAKE: Duration = Duration::from_secs(4);
/// How long an answer may take.
pub(super) const ANSWER: Duration = Duration::from_millis(500);
/// How often a machine that does not answer is asked again: one that wakes up loses what comes.
const AGAIN: Duration = Duration::from_millis(250);
/// The least time between two looks of a caller that has run out of it.
const GLANCE: Duration = Duration::from_millis(50);

impl Machine {
    /// Opens the line and waits until the machine answers; nothing moves.
    pub(super) fn open(options: SerialOptions) -> Result<Machine, DriverError> {
        let link = SerialLink::open(&KEY, &options.port, options.baud, read)?;
        let stop = Arc::new(Stop::new(KEY, link.writer().clone(), HOLD));
        let mut machine = Machine {
            link,
            stop,
            options,
        };
        let until = monotonic() + AWAKE;
        while let Err(error) = machine.look(AGAIN) {
            if error.kind() != ErrorKind::Timeout || monotonic() >= until {
                return Err(error);
            }
        }
        Ok(machine)
    }

    /// What the machine does now.
    pub(super) fn look(&mut self, patience: Duration) -> Result<Seen<Status>, DriverError> {
        let doing = "ask where the machine is";
        let statuses = self.link.statuses();
        let after = statuses.posted();
        self.link
            .writer()
            .send(ASK_STATUS)
            .map_err(|error| failed(ErrorKind::Disconnected, doing, error))?;
        // Whoever has no time left is answered all the same, if the machine answers at once.
        statuses.next(after, patience.max(GLANCE)).map_err(|none| {
            none.while_waiting(&KEY, doing, || {
                format!(
                    "no status with `MPos:` within {patience:?}, as GRBL 1.1 with $10=1 gives it"
                )
            })
        })
    }

    /// Throws away what a machine at rest still has to do, so that it is idle.
    pub(super) fn empty(&mut self, doing: &'static str) -> Result<(), DriverError> {
        let until = monotonic() + ANSWER;
        loop {
            let state = self.look(ANSWER)?.what.state;
            match state {
                State::Idle => return Ok(()),
                // At rest nothing is lost by a reset; on the way the place would be.
                State::Held => {
                    let reset = self.link.writer().send(RESET);
                    reset.map_err(|error| failed(ErrorKind::Disconnected, doing, error))?;
                }
                State::Slowing | State::Running if monotonic() < until => {}
                State::Alarm => return Err(alarm(doing)),
                _ => {
                    let why = format!("it does not come to rest, it stays {state:?}");
                    return Err(failed(ErrorKind::DeviceFault, doing, why));
                }
            }
        }
    }
}

pub(super) fn alarm(doing: &'static str) -> DriverError {
    let why = "the machine is in alarm: look at it, then reset and home it, which this program never does";
    failed(ErrorKind::DeviceFault, doing, why)
}

impl Robot for Machine {
    fn pose(&mut self, deadline: Deadline) -> Result<(Pose, Stamp), DriverError> {
        let seen = self.look(deadline.remaining())?;
        let [x, y, z] = seen.what.place_mm.map(Millimetre);
        let pose = Pose {
            position: Point { x, y, z },
            ..Pose::default()
        };
        check_pose(&pose)
            .map_err(|error| failed(ErrorKind::DeviceFault, "ask where the machine is", error))?;
        Ok((pose.on_grid(), Stamp::at(seen.at)))
    }

    fn move_to(
        &mut self,
        target: Pose,
        speed: Speed,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        self.options.check(&KEY, &target, speed)?;
        self.go(target, speed, deadline)
    }

    fn halt_handle(&self) -> Arc<dyn Halt> {
        Arc::clone(&self.stop) as Arc<dyn Halt>
    }

    fn clear_halt(&mut self, _: Deadline) -> Result<(), DriverError> {
        // First, so that a halt which comes meanwhile stays.
        self.stop.release();
        self.empty("end the halt")
    }
}

impl Drop for Machine {
    fn drop(&mut self) {
        self.stop.retire();
    }
}
