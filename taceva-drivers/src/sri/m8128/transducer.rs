//! The box as a force transducer.

use std::sync::Arc;
use std::time::Duration;

use taceva_core::{
    Axes, Deadline, DriverError, ErrorKind, ForceTransducer, Interrupt, Newton, NewtonMillimetre,
    Stamp, Tare, Wrench, check_wrench,
};

use super::KEY;
use super::box_link::{BoxLink, CommandError, Counted};
use super::command::Command;
use super::frame::{Check, Reading};
use crate::link::Seen;
use crate::zero::{HostZero, READ, ZERO};

/// How a box is read.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct M8128Options {
    pub(super) host: String,
    pub(super) port: u16,
    pub(super) rate_hz: u16,
    pub(super) check: Check,
    /// What it measures is clipped at this force, in N.
    pub(super) force_max_n: Option<f64>,
    /// N·mm a unit of torque of the box.
    pub(super) torque_unit_nmm: f64,
    pub(super) zero: Zero,
}

/// Who calls a load zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Zero {
    /// This program, by the mean of some readings.
    Host,
    /// The box, which must not send meanwhile.
    Box,
}

/// A transducer that is connected.
#[derive(Debug)]
pub(super) struct Transducer {
    link: BoxLink,
    options: M8128Options,
    /// What is taken off every reading.
    zero: HostZero,
    is_running: bool,
    /// The number that the box gave the last reading.
    sequence: Option<u64>,
    /// The number of the last reading that was given.
    last: u64,
}

/// How long the box may take to answer a command.
const ANSWER: Duration = Duration::from_millis(800);
/// How long it is waited for the answer to a stop, which not every box gives.
const STOPPED: Duration = Duration::from_millis(150);
/// How long the box may take to find its zero.
const ZEROED: Duration = Duration::from_secs(4);

fn failed(
    kind: ErrorKind,
    doing: &'static str,
    why: impl Into<Box<dyn std::error::Error + Send + Sync>>,
) -> DriverError {
    DriverError::new(kind, &KEY, doing).because(why)
}

impl Transducer {
    /// Connects to a box; nothing of its settings changes until it is started.
    pub(super) fn open(options: M8128Options) -> Result<Transducer, DriverError> {
        let link = BoxLink::open(&options.host, options.port)
            .map_err(|error| failed(error.kind(), "connect to the box", error))?;
        Ok(Transducer {
            link,
            zero: HostZero::new(KEY, options.force_max_n),
            options,
            is_running: false,
            sequence: None,
            last: 0,
        })
    }

    /// Tells the box to send nothing; whether it confirms is not the same for all.
    fn fall_silent(&mut self) -> Result<(), CommandError> {
        self.is_running = false;
        match self.link.command(Command::Stop, STOPPED) {
            Err(CommandError::Link(error)) => Err(error.into()),
            _ => Ok(()),
        }
    }

    fn begin(&mut self) -> Result<(), CommandError> {
        self.fall_silent()?;
        let rate = self.options.rate_hz;
        match self.link.command(Command::Rate(rate), ANSWER) {
            Err(CommandError::Refused { .. }) => {
                self.link.command(Command::OldRate(rate), ANSWER)?;
            }
            done => done?,
        }
        self.link
            .command(Command::Check(self.options.check), ANSWER)?;
        self.link.command(Command::Units, ANSWER)?;
        self.last = self.link.readings().posted();
        self.link.send(Command::Start)?;
        self.is_running = true;
        Ok(())
    }

    fn next(&mut self, patience: Duration) -> Result<Seen<Counted>, DriverError> {
        if !self.is_running {
            let why = "it is not started";
            return Err(failed(ErrorKind::InvalidArgument, READ, why));
        }
        let found = self.link.readings().next(self.last, patience);
        let seen = found.map_err(|none| {
            none.while_waiting(&KEY, READ, || {
                format!("no reading within {patience:?}{}", self.losses())
            })
        })?;
        self.last = seen.number;
        self.sequence = Some(u64::from(seen.what.reading.number));
        Ok(seen)
    }

    /// What was lost on the way so far, in words; nothing on a link that is well.
    fn losses(&self) -> String {
        match self.link.readings().newest().map(|seen| seen.what) {
            Some(Counted {
                missing,
                lost_bytes,
                ..
            }) if missing + lost_bytes > 0 => {
                format!("; {missing} frames were missing and {lost_bytes} bytes were in no frame")
            }
            _ => String::new(),
        }
    }

    /// What a reading says in our units, the zero of the box in it.
    fn wrench(&self, reading: &Reading) -> Result<Wrench, DriverError> {
        let [fx, fy, fz, mx, my, mz] = reading.values.map(f64::from);
        let unit = self.options.torque_unit_nmm;
        let wrench = Wrench {
            force: [fx, fy, fz].map(Newton),
            torque: [mx, my, mz].map(|torque| NewtonMillimetre(torque * unit)),
        };
        check_wrench(&wrench).map_err(|error| failed(ErrorKind::DeviceFault, READ, error))?;
        self.zero.check(&wrench)?;
        Ok(wrench)
    }
}

impl ForceTransducer for Transducer {
    fn axes(&self) -> Axes {
        Axes::SIX
    }

    fn start(&mut self, _: Deadline) -> Result<(), DriverError> {
        if self.is_running {
            return Ok(());
        }
        let begun = self.begin();
        begun.map_err(|error| failed(error.kind(), "start the readings", error))
    }

    fn read(&mut self, deadline: Deadline) -> Result<(Wrench, Stamp), DriverError> {
        let seen = self.next(deadline.remaining())?;
        let wrench = self.zero.taken_off(&self.wrench(&seen.what.reading)?)?;
        Ok((wrench, Stamp::at(seen.at)))
    }

    fn sequence(&self) -> Option<u64> {
        self.sequence
    }

    fn stop(&mut self) -> Result<(), DriverError> {
        if !self.is_running {
            return Ok(());
        }
        let stopped = self.fall_silent();
        stopped.map_err(|error| failed(error.kind(), "end the readings", error))
    }

    fn interrupt_handle(&self) -> Option<Arc<dyn Interrupt>> {
        Some(Arc::clone(self.link.readings()) as Arc<dyn Interrupt>)
    }

    fn tare(&mut self) -> Option<&mut dyn Tare> {
        Some(self)
    }
}

impl Tare for Transducer {
    fn zero(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        match self.options.zero {
            Zero::Host => self.zero_here(deadline),
            Zero::Box => self.zero_in_box(deadline),
        }
    }
}

impl Transducer {
    fn zero_here(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        let mut zero = self.zero.clone();
        let next = |patience| {
            let seen = self.next(patience)?;
            self.wrench(&seen.what.reading)
        };
        zero.take(deadline, next)?;
        self.zero = zero;
        Ok(())
    }

    fn zero_in_box(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        let refused = |error: CommandError| failed(error.kind(), ZERO, error);
        let was_running = self.is_running;
        // While it sends, its answer is lost among readings.
        self.fall_silent().map_err(refused)?;
        let patience = deadline.remaining().min(ZEROED);
        let zeroed = self.link.command(Command::Zero, patience);
        if was_running {
            self.begin().map_err(refused)?;
        }
        zeroed.map_err(refused)?;
        self.zero.forget();
        Ok(())
    }
}
