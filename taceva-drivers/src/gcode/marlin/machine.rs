//! Robot that is a Marlin printer.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use taceva_core::{
    Deadline, DriverError, ErrorKind, Halt, Millimetre, Point, Pose, Robot, Speed, Stamp,
    check_pose,
};

use super::KEY;
use super::line::{MARK, Place, numbered, read};
use crate::gcode::limits::{MOVE, SerialOptions};
use crate::gcode::link::{Answer, CommandError, SerialLink};
use crate::gcode::stop::Stop;
use crate::link::{Seen, monotonic};

/// A connected printer.
#[derive(Debug)]
pub(super) struct Printer {
    pub(super) link: SerialLink<Place>,
    pub(super) stop: Arc<Stop>,
    options: SerialOptions,
    /// Number in the last request for an echo.
    pub(super) mark: u32,
    /// Number of the last line with a checksum; `None` if the firmware does not count lines.
    line: Option<u32>,
    is_emulated: bool,
    /// Firmware, machine type and UUID, as far as the printer reported them.
    facts: BTreeMap<String, String>,
}

/// Command that ends every motion at once, if the printer accepts it during a motion.
pub(super) const QUICK_STOP: &[u8] = b"M410\n";
/// Capability to stop during a motion. Without it, a stop waits for the end of the motion.
const STOPS_AT_ONCE: &str = "EMERGENCY_PARSER";
/// Capability that only an emulated printer reports (`taceva-wire`).
const EMULATED: &str = "TACEVA_SIM";
const CONNECT: &str = "connect to the printer";
const LOOK: &str = "read the position of the printer";
/// Timeout for the first answer after the port is opened. Opening resets many boards.
const AWAKE: Duration = Duration::from_secs(10);
/// Timeout for an answer.
pub(super) const ANSWER: Duration = Duration::from_millis(800);
/// Maximum number of attempts to send a line that arrives damaged.
const SENT: u32 = 4;
/// Minimum timeout of a query, even if the caller's deadline has passed.
const GLANCE: Duration = Duration::from_millis(100);

impl Printer {
    /// Opens the serial port and waits until the printer answers. Nothing moves.
    pub(super) fn open(options: SerialOptions) -> Result<Printer, DriverError> {
        let link = SerialLink::open(&KEY, &options.port, options.baud, read)?;
        let stop = Arc::new(Stop::new(KEY, link.writer().clone(), QUICK_STOP));
        let mut printer = Printer {
            link,
            stop,
            options,
            mark: 0,
            line: None,
            is_emulated: false,
            facts: BTreeMap::new(),
        };
        let until = monotonic() + AWAKE;
        // A printer that wakes up drops input.
        while let Err(error) = printer.agree(ANSWER) {
            if !matches!(error, CommandError::Silent { .. }) || monotonic() >= until {
                return Err(error.met(&KEY, CONNECT));
            }
        }
        let (mut stops_at_once, mut is_emulated) = (None, false);
        let mut facts = BTreeMap::new();
        let listed = printer.ask("M115\n", ANSWER, |answer| match answer {
            Answer::Can(name, is) if name == STOPS_AT_ONCE => stops_at_once = Some(is),
            Answer::Can(name, is) if name == EMULATED => is_emulated = is,
            Answer::Facts(stated) => facts = stated,
            _ => {}
        });
        listed.map_err(|error| error.met(&KEY, CONNECT))?;
        printer.is_emulated = is_emulated;
        printer.facts = facts;
        let first = numbered(0, "M110 N0");
        printer.line = match printer.link.command(&first, ANSWER, drop) {
            Ok(()) => Some(0),
            Err(error @ (CommandError::Fault(_) | CommandError::Broken(_))) => {
                return Err(error.met(&KEY, CONNECT));
            }
            Err(_) => None,
        };
        if stops_at_once != Some(true) {
            let why = "the printer does not report `Cap:EMERGENCY_PARSER:1`, so a stop would take effect only at the end of the motion: build its firmware with EMERGENCY_PARSER";
            return Err(DriverError::new(ErrorKind::Unsupported, &KEY, CONNECT).because(why));
        }
        Ok(printer)
    }

    /// Returns the lines `before`, then a request to echo a new number. The printer sends the echo after it executes the lines. Each request has its
    /// own number, so that a repeated echo or `ok` ends no later command.
    pub(super) fn marked(&mut self, before: &str) -> String {
        self.mark = self.mark.wrapping_add(1);
        format!("{before}M118 {MARK}{}", self.mark)
    }

    /// Skips the answers to earlier commands, so that the next answer belongs to the next command.
    pub(super) fn agree(&mut self, patience: Duration) -> Result<(), CommandError> {
        self.ask("", patience, drop)
    }

    /// Sends the lines `before` and waits until they are carried out. Passes their answers to `other`.
    fn ask(
        &mut self,
        before: &str,
        patience: Duration,
        mut other: impl FnMut(Answer),
    ) -> Result<(), CommandError> {
        let lines = self.marked(before);
        let unknown = format!("\"M118 {MARK}{}\"", self.mark);
        let until = monotonic() + patience;
        self.link.send(&lines)?;
        let mut is_marked = false;
        loop {
            let left = until.saturating_sub(monotonic());
            match self.link.answer(left) {
                Some(Answer::Mark(mark)) if mark == self.mark => is_marked = true,
                Some(Answer::Ok) if is_marked => return Ok(()),
                Some(Answer::Fault(why)) => return Err(CommandError::Fault(why)),
                // Firmware without `M118`.
                Some(Answer::Refused(why)) if why.contains(&unknown) => {
                    let command = "M118".to_owned();
                    return Err(CommandError::Refused { command, why });
                }
                Some(answer) => other(answer),
                None => {
                    let command = lines.replace('\n', "`, `");
                    return Err(CommandError::Silent { command, patience });
                }
            }
        }
    }

    /// Sends a motion command, with a line number and a checksum if the firmware counts lines. A command that arrives damaged is sent again, unless
    /// the printer was halted.
    pub(super) fn order(&mut self, command: &str) -> Result<(), DriverError> {
        let refused = |error: CommandError| error.met(&KEY, MOVE);
        for _ in 0..SENT {
            // No motion begins after a halt.
            if self.stop.is_halted() {
                return Err(self.stop.halted());
            }
            let Some(last) = self.line else {
                return self.link.command(command, ANSWER, drop).map_err(refused);
            };
            let number = last.wrapping_add(1);
            let mut wanted = None;
            self.link
                .command(&numbered(number, command), ANSWER, |answer| {
                    if let Answer::Resend(asked) = answer {
                        wanted = Some(asked);
                    }
                })
                .map_err(refused)?;
            match wanted {
                None => {
                    self.line = Some(number);
                    return Ok(());
                }
                Some(asked) if asked == number => {}
                // The line before arrived, but its answer did not.
                Some(asked) if asked == number.wrapping_add(1) => self.line = Some(number),
                Some(asked) => {
                    let why = format!(
                        "the printer expects line {asked} instead of {number}, as after a restart: home the printer again, because it has lost its position"
                    );
                    return Err(refused(CommandError::Fault(why)));
                }
            }
        }
        let command = command.to_owned();
        let why =
            format!("the command arrived damaged {SENT} times: check the cable and its length");
        Err(refused(CommandError::Refused { command, why }))
    }

    /// Queries the position of the tip. A printer at rest reports the current position, and a moving printer reports the planned position.
    pub(super) fn look(&mut self, patience: Duration) -> Result<Seen<Place>, DriverError> {
        let after = self.link.statuses().posted();
        let patience = patience.max(GLANCE);
        self.link
            .command("M114", patience, drop)
            .map_err(|error| error.met(&KEY, LOOK))?;
        let seen = self.link.statuses().next(after, patience);
        seen.map_err(|none| {
            none.while_waiting(&KEY, LOOK, || format!("no position within {patience:?}"))
        })
    }
}

impl Robot for Printer {
    fn is_emulated(&self) -> bool {
        self.is_emulated
    }

    fn settings(&self) -> BTreeMap<String, String> {
        self.facts.clone()
    }

    fn warnings(&self) -> Vec<String> {
        self.link.warning().into_iter().collect()
    }

    fn pose(&mut self, deadline: Deadline) -> Result<(Pose, Stamp), DriverError> {
        let seen = self.look(deadline.remaining())?;
        let [x, y, z] = seen.what.map(Millimetre);
        let pose = Pose {
            position: Point { x, y, z },
            ..Pose::default()
        };
        check_pose(&pose)
            .map_err(|error| DriverError::new(ErrorKind::DeviceFault, &KEY, LOOK).because(error))?;
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

    fn clear_halt(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        // Release first, so that a concurrent halt is kept.
        self.stop.release();
        // A stopped printer may still work on earlier commands.
        self.agree(deadline.remaining().max(GLANCE))
            .map_err(|error| error.met(&KEY, "end the halt"))
    }
}

impl Drop for Printer {
    fn drop(&mut self) {
        self.stop.retire();
    }
}
