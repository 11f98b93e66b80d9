//! The printer as a robot.

use std::sync::Arc;
use std::time::Duration;

use taceva_core::{
    Deadline, DriverError, ErrorKind, Halt, Millimetre, Point, Pose, Robot, Speed, Stamp,
    check_pose,
};

use super::KEY;
use super::line::{MARK, Place, read};
use crate::gcode::limits::SerialOptions;
use crate::gcode::link::{Answer, CommandError, SerialLink};
use crate::gcode::stop::Stop;
use crate::link::{Seen, monotonic};

/// A printer that is connected.
#[derive(Debug)]
pub(super) struct Printer {
    pub(super) link: SerialLink<Place>,
    pub(super) stop: Arc<Stop>,
    options: SerialOptions,
    /// The last number that it was asked to repeat.
    mark: u32,
}

/// Ends every motion at once, where the printer takes it while it moves.
pub(super) const QUICK_STOP: &[u8] = b"M410\n";
/// The capability without which a stop waits behind the motion that it is to stop.
const STOPS_AT_ONCE: &str = "EMERGENCY_PARSER";
const CONNECT: &str = "connect to the printer";
const LOOK: &str = "ask where the printer is";
/// How long a printer may take after its line was opened, which resets many, until it answers.
const AWAKE: Duration = Duration::from_secs(10);
/// How long an answer may take.
pub(super) const ANSWER: Duration = Duration::from_millis(800);
/// The least time between two looks of a caller that has run out of it.
const GLANCE: Duration = Duration::from_millis(100);

impl Printer {
    /// Opens the line and waits until the printer answers; nothing moves.
    pub(super) fn open(options: SerialOptions) -> Result<Printer, DriverError> {
        let link = SerialLink::open(&KEY, &options.port, options.baud, read)?;
        let stop = Arc::new(Stop::new(KEY, link.writer().clone(), QUICK_STOP));
        let mut printer = Printer {
            link,
            stop,
            options,
            mark: 0,
        };
        let until = monotonic() + AWAKE;
        // One that wakes up loses what comes.
        while let Err(error) = printer.agree(ANSWER) {
            if !matches!(error, CommandError::Silent { .. }) || monotonic() >= until {
                return Err(error.met(&KEY, CONNECT));
            }
        }
        let mut stops_at_once = None;
        let listed = printer.link.command("M115", ANSWER, |answer| {
            if let Answer::Can(name, is) = answer
                && name == STOPS_AT_ONCE
            {
                stops_at_once = Some(is);
            }
        });
        listed.map_err(|error| error.met(&KEY, CONNECT))?;
        if stops_at_once != Some(true) {
            let why = "the printer does not say `Cap:EMERGENCY_PARSER:1`, so that a stop would wait behind the motion: build its firmware with EMERGENCY_PARSER";
            return Err(DriverError::new(ErrorKind::Unsupported, &KEY, CONNECT).because(why));
        }
        Ok(printer)
    }

    /// Makes sure that the next answer is one to the next command: those that are still under way are passed over.
    pub(super) fn agree(&mut self, patience: Duration) -> Result<(), CommandError> {
        self.mark = self.mark.wrapping_add(1);
        let command = format!("M118 {MARK}{}", self.mark);
        let until = monotonic() + patience;
        self.link.send(&command)?;
        let mut is_marked = false;
        loop {
            let left = until.saturating_sub(monotonic());
            match self.link.answer(left) {
                Some(Answer::Mark(mark)) if mark == self.mark => is_marked = true,
                Some(Answer::Ok) if is_marked => return Ok(()),
                Some(Answer::Fault(why)) => return Err(CommandError::Fault(why)),
                Some(_) => {}
                None => return Err(CommandError::Silent { command, patience }),
            }
        }
    }

    /// Where the printer says that its tip is: at rest where it is, on its way where it is going to be.
    pub(super) fn look(&mut self, patience: Duration) -> Result<Seen<Place>, DriverError> {
        let after = self.link.statuses().posted();
        let patience = patience.max(GLANCE);
        self.link
            .command("M114", patience, drop)
            .map_err(|error| error.met(&KEY, LOOK))?;
        let seen = self.link.statuses().next(after, patience);
        seen.map_err(|none| {
            none.while_waiting(&KEY, LOOK, || format!("no place within {patience:?}"))
        })
    }
}

impl Robot for Printer {
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
        // First, so that a halt which comes meanwhile stays.
        self.stop.release();
        // A printer that was stopped may still work on what it has taken before.
        self.agree(deadline.remaining().max(GLANCE))
            .map_err(|error| error.met(&KEY, "end the halt"))
    }
}

impl Drop for Printer {
    fn drop(&mut self) {
        self.stop.retire();
    }
}
