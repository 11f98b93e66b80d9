//! Robot that is a GRBL machine.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use taceva_core::{
    Deadline, DriverError, ErrorKind, Halt, Millimetre, Point, Pose, Robot, Speed, Stamp,
    check_pose,
};

use super::KEY;
use super::line::{State, Status, read};
use crate::gcode::limits::SerialOptions;
use crate::gcode::link::{Answer, SerialLink};
use crate::gcode::stop::Stop;
use crate::link::{Seen, monotonic};

/// A connected machine.
#[derive(Debug)]
pub(super) struct Machine {
    pub(super) link: SerialLink<Status>,
    pub(super) stop: Arc<Stop>,
    options: SerialOptions,
    /// Firmware version and owner's text, as the machine reported them; empty if the machine was in motion.
    facts: BTreeMap<String, String>,
}

/// Real-time command that requests the status.
const ASK_STATUS: &[u8] = b"?";
/// Command that requests the version.
const ASK_FACTS: &str = "$I";
pub(super) const HOLD: &[u8] = b"!";
const RESET: &[u8] = &[0x18];

/// Creates an error of this driver with the reason `why`.
pub(super) fn failed(
    kind: ErrorKind,
    doing: &'static str,
    why: impl Into<Box<dyn std::error::Error + Send + Sync>>,
) -> DriverError {
    DriverError::new(kind, &KEY, doing).because(why)
}

/// Timeout for the first answer after the port is opened. Opening resets many boards.
const AWAKE: Duration = Duration::from_secs(4);
/// Timeout for an answer.
pub(super) const ANSWER: Duration = Duration::from_millis(500);
/// Interval of queries while the machine restarts and ignores input.
const AGAIN: Duration = Duration::from_millis(250);
/// Minimum timeout of a query, even if the caller's deadline has passed.
const GLANCE: Duration = Duration::from_millis(50);

impl Machine {
    /// Opens the serial port and waits until the machine answers. Nothing moves. If an earlier run left the machine in a hold, ends the hold and
    /// discards the pending commands.
    pub(super) fn open(options: SerialOptions) -> Result<Machine, DriverError> {
        let link = SerialLink::open(&KEY, &options.port, options.baud, read)?;
        let stop = Arc::new(Stop::new(KEY, link.writer().clone(), HOLD));
        let mut machine = Machine {
            link,
            stop,
            options,
            facts: BTreeMap::new(),
        };
        let until = monotonic() + AWAKE;
        let state = loop {
            match machine.look(AGAIN) {
                Ok(seen) => break seen.what.state,
                Err(error) if error.kind() != ErrorKind::Timeout || monotonic() >= until => {
                    return Err(error);
                }
                Err(_) => {}
            }
        };
        // In a hold GRBL does not state its version, which a resumed recording must have.
        if state == State::Held {
            machine.empty("end the hold of an earlier run")?;
        }
        let mut facts = BTreeMap::new();
        let stated = machine.link.command(ASK_FACTS, ANSWER, |answer| {
            if let Answer::Facts(found) = answer {
                facts = found;
            }
        });
        // GRBL answers this only when idle or in alarm.
        drop(stated);
        machine.facts = facts;
        Ok(machine)
    }

    /// Queries the current status.
    pub(super) fn look(&mut self, patience: Duration) -> Result<Seen<Status>, DriverError> {
        let doing = "read the position of the machine";
        let statuses = self.link.statuses();
        let after = statuses.posted();
        self.link
            .writer()
            .send(ASK_STATUS)
            .map_err(|error| failed(ErrorKind::Disconnected, doing, error))?;
        // A caller past its deadline still gets an immediate answer.
        statuses.next(after, patience.max(GLANCE)).map_err(|none| {
            none.while_waiting(&KEY, doing, || {
                format!(
                    "no status with `MPos:` within {patience:?}: use GRBL 1.1 with the setting $10=1"
                )
            })
        })
    }

    /// Waits until the machine is at rest, then discards its pending commands. The machine is idle afterwards.
    pub(super) fn empty(&mut self, doing: &'static str) -> Result<(), DriverError> {
        let until = monotonic() + ANSWER;
        loop {
            let state = self.look(ANSWER)?.what.state;
            match state {
                State::Idle => return Ok(()),
                // A reset at rest keeps the position; a reset during motion loses it.
                State::Held => {
                    let reset = self.link.writer().send(RESET);
                    reset.map_err(|error| failed(ErrorKind::Disconnected, doing, error))?;
                }
                State::Slowing | State::Running if monotonic() < until => {}
                State::Alarm => return Err(alarm(doing)),
                _ => {
                    let why =
                        format!("the machine does not come to rest; its state is still {state:?}");
                    return Err(failed(ErrorKind::DeviceFault, doing, why));
                }
            }
        }
    }
}

pub(super) fn alarm(doing: &'static str) -> DriverError {
    let why = "the machine is in alarm: inspect it, then reset and home it by hand";
    failed(ErrorKind::DeviceFault, doing, why)
}

impl Robot for Machine {
    fn settings(&self) -> BTreeMap<String, String> {
        self.facts.clone()
    }

    fn warnings(&self) -> Vec<String> {
        self.link.warning().into_iter().collect()
    }

    fn pose(&mut self, deadline: Deadline) -> Result<(Pose, Stamp), DriverError> {
        let seen = self.look(deadline.remaining())?;
        let [x, y, z] = seen.what.place_mm.map(Millimetre);
        let pose = Pose {
            position: Point { x, y, z },
            ..Pose::default()
        };
        check_pose(&pose).map_err(|error| {
            failed(
                ErrorKind::DeviceFault,
                "read the position of the machine",
                error,
            )
        })?;
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
        // Release first, so that a concurrent halt is kept.
        self.stop.release();
        self.empty("end the halt")
    }
}

impl Drop for Machine {
    fn drop(&mut self) {
        self.stop.retire();
    }
}
