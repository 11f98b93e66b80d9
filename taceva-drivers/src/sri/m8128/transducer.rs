//! Force transducer that is read through an SRI interface box.

use std::collections::BTreeMap;
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
use crate::text::shown;
use crate::zero::{HostZero, READ, ZERO};

/// Options for opening an interface box.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct M8128Options {
    pub(super) host: String,
    pub(super) port: u16,
    pub(super) rate_hz: u16,
    pub(super) check: Check,
    /// Measuring range of the forces, N; `None` if unknown.
    pub(super) force_max_n: Option<f64>,
    /// Size of the box's torque unit, N·mm.
    pub(super) torque_unit_nmm: f64,
    pub(super) zero: Zero,
}

/// Device that subtracts the zero offset.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Zero {
    /// The driver subtracts the mean of the readings over 0.25 s.
    Host,
    /// The box stores and subtracts the zero offset. The driver stops the readings while the box sets the offset.
    Box,
}

/// Force transducer behind a connected interface box.
#[derive(Debug)]
pub(super) struct Transducer {
    link: BoxLink,
    options: M8128Options,
    /// Zero offset that is subtracted from every reading, and measuring range.
    zero: HostZero,
    /// Decoupling matrix and its unit, by name, if the box states them.
    facts: BTreeMap<String, String>,
    is_running: bool,
    /// Sequence number of the last reading; `None` before the first.
    sequence: Option<u64>,
    /// Mailbox number of the reading that the driver returned last.
    last: u64,
}

/// Timeout for the answer to a command that changes a setting.
const ANSWER: Duration = Duration::from_millis(800);
/// Timeout for the answer to a stop, which some boxes omit.
const STOPPED: Duration = Duration::from_millis(150);
/// Timeout for the answer to a query, which old boxes may omit.
const ASKED: Duration = Duration::from_millis(300);
/// Timeout for zeroing in the box.
const ZEROED: Duration = Duration::from_secs(4);

fn failed(
    kind: ErrorKind,
    doing: &'static str,
    why: impl Into<Box<dyn std::error::Error + Send + Sync>>,
) -> DriverError {
    DriverError::new(kind, &KEY, doing).because(why)
}

/// Queries the decoupling matrix and its unit. Returns the answers by name, and omits a query without a valid answer.
fn stated_facts(link: &mut BoxLink) -> BTreeMap<String, String> {
    let mut facts = BTreeMap::new();
    for (name, query) in [
        ("decoupling", Command::AskMatrix),
        ("decoupling_unit", Command::AskUnit),
    ] {
        let answer = link.command(query, ASKED).ok();
        let value = answer.as_deref().and_then(|line| query.value_in(line));
        if let Some(value) = value {
            facts.insert(name.to_owned(), shown(value));
        }
    }
    facts
}

impl Transducer {
    /// Connects to a box. The settings of the box stay unchanged until readings start.
    pub(super) fn open(options: M8128Options) -> Result<Transducer, DriverError> {
        let mut link = BoxLink::open(&options.host, options.port)
            .map_err(|error| failed(error.kind(), "connect to the box", error))?;
        let facts = stated_facts(&mut link);
        Ok(Transducer {
            link,
            zero: HostZero::new(KEY, options.force_max_n),
            options,
            facts,
            is_running: false,
            sequence: None,
            last: 0,
        })
    }

    /// Stops the readings. Some boxes do not confirm the stop.
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
            done => drop(done?),
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
            let why = "the transducer is not started";
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

    /// Describes lost frames and bytes for an error message; empty if there are none.
    fn losses(&self) -> String {
        match self.link.readings().newest().map(|seen| seen.what) {
            Some(Counted {
                missing,
                lost_bytes,
                ..
            }) if missing + lost_bytes > 0 => {
                format!("; {missing} frames were lost and {lost_bytes} bytes belonged to no frame")
            }
            _ => String::new(),
        }
    }

    /// Converts a reading to N and N·mm and checks its range. Does not subtract the zero offset.
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

    fn settings(&self) -> BTreeMap<String, String> {
        let mut settings = self.facts.clone();
        // The box confirms both before its first reading.
        let check = match self.options.check {
            Check::Sum => "sum",
            Check::Crc32 => "crc32",
        };
        settings.insert("rate_hz".to_owned(), self.options.rate_hz.to_string());
        settings.insert("check".to_owned(), check.to_owned());
        settings
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

    fn lost(&self) -> Option<u64> {
        let newest = self.link.readings().newest();
        Some(newest.map_or(0, |seen| seen.what.missing))
    }

    fn stop(&mut self) -> Result<(), DriverError> {
        if !self.is_running {
            return Ok(());
        }
        let stopped = self.fall_silent();
        stopped.map_err(|error| failed(error.kind(), "stop the readings", error))
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
        // During sending, the answer would be lost among readings.
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
