//! Force transducer that is connected through a Net F/T box.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use taceva_core::{
    Axes, Deadline, DriverError, ErrorKind, ForceTransducer, Interrupt, Newton, NewtonMillimetre,
    Stamp, Tare, Wrench,
};

use super::KEY;
use super::calibration::Calibration;
use super::page::Page;
use super::record::{Record, Request};
use super::setup::{Expected, Setup};
use super::stream::{Counted, RecordStream};
use crate::link::{LinkError, Mailbox, Seen};
use crate::zero::{HostZero, READ};

/// Options for the connection to a Net F/T box.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct NetftOptions {
    pub(super) host: String,
    pub(super) port: u16,
    pub(super) page_port: u16,
    pub(super) expected: Expected,
}

/// Open connection to a force transducer through a Net F/T box.
#[derive(Debug)]
pub(super) struct Transducer {
    options: NetftOptions,
    calibration: Calibration,
    setup: Setup,
    records: Arc<Mailbox<Counted>>,
    stream: RecordStream,
    zero: HostZero,
    is_running: bool,
    /// True after a reading with a latched threshold.
    is_latched: bool,
    /// Sequence number of the last reading; `None` before the first.
    sequence: Option<u64>,
    /// Number that the mailbox gave to the record returned last.
    last: u64,
}

fn failed(
    kind: ErrorKind,
    doing: &'static str,
    why: impl Into<Box<dyn std::error::Error + Send + Sync>>,
) -> DriverError {
    DriverError::new(kind, &KEY, doing).because(why)
}

impl Transducer {
    /// Reads the calibration and the settings of a box and opens a socket for its records. Does not start the readings.
    pub(super) fn open(options: NetftOptions) -> Result<Transducer, DriverError> {
        let doing = "connect to the box";
        let page = Page::ask(&options.host, options.page_port)
            .map_err(|error| failed(error.kind(), doing, error))?;
        let calibration =
            Calibration::read(&page).map_err(|error| failed(error.kind(), doing, error))?;
        let setup = Setup::read(&page, calibration.force_unit_n)
            .map_err(|error| failed(error.kind(), doing, error))?;
        setup
            .check(&options.expected)
            .map_err(|why| failed(ErrorKind::InvalidArgument, doing, why))?;
        let zero = match options.expected.force_max_n {
            Some(most) => HostZero::new(KEY, Some(most)),
            None => HostZero::of_axes(KEY, setup.ranges_n()),
        };
        let records = Arc::new(Mailbox::default());
        let stream = RecordStream::open(&options.host, options.port, &records)
            .map_err(|error| failed(error.kind(), doing, error))?;
        Ok(Transducer {
            zero,
            options,
            calibration,
            setup,
            records,
            stream,
            is_running: false,
            is_latched: false,
            sequence: None,
            last: 0,
        })
    }

    fn begin(&mut self) -> Result<(), LinkError> {
        if self.records.has_ended() {
            self.records.begin_again();
            let NetftOptions { host, port, .. } = &self.options;
            self.stream = RecordStream::open(host, *port, &self.records)?;
        }
        self.last = self.records.posted();
        self.stream.send(Request::Start)?;
        self.is_running = true;
        Ok(())
    }

    fn next(&mut self, patience: Duration) -> Result<Seen<Counted>, DriverError> {
        if !self.is_running {
            let why = "the transducer is not started";
            return Err(failed(ErrorKind::InvalidArgument, READ, why));
        }
        let found = self.records.next(self.last, patience);
        let seen = found.map_err(|none| {
            none.while_waiting(&KEY, READ, || {
                let missing = self.missing();
                format!("no reading within {patience:?}; {missing} earlier readings were lost")
            })
        })?;
        self.last = seen.number;
        self.sequence = Some(u64::from(seen.what.record.number));
        self.is_latched |= seen.what.record.status.is_latched();
        Ok(seen)
    }

    /// Number of records lost since the socket was opened, computed from gaps in the sequence numbers.
    fn missing(&self) -> u64 {
        self.records.newest().map_or(0, |seen| seen.what.missing)
    }

    /// Converts a record to forces, N, and torques, N·mm. The zero offset is not subtracted.
    fn wrench(&self, record: &Record) -> Result<Wrench, DriverError> {
        let status = record.status;
        if status.is_saturated() {
            let why = format!("the force is clipped, {status}: reduce the load");
            return Err(failed(ErrorKind::OutOfRange, READ, why));
        }
        if status.has_error() {
            let why = format!(
                "the box reports {status}, expected status 0x00000000: its manual explains each bit; a restart of the box clears most bits"
            );
            return Err(failed(ErrorKind::DeviceFault, READ, why));
        }
        let Calibration {
            force_n,
            torque_nmm,
            ..
        } = self.calibration;
        let [fx, fy, fz, tx, ty, tz] = record.counts.map(f64::from);
        let wrench = Wrench {
            force: [fx, fy, fz].map(|counts| Newton(counts * force_n)),
            torque: [tx, ty, tz].map(|counts| NewtonMillimetre(counts * torque_nmm)),
        };
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
        let wrench = self.zero.taken_off(&self.wrench(&seen.what.record)?)?;
        Ok((wrench, Stamp::at(seen.at)))
    }

    fn sequence(&self) -> Option<u64> {
        self.sequence
    }

    fn lost(&self) -> Option<u64> {
        Some(self.missing())
    }

    fn stop(&mut self) -> Result<(), DriverError> {
        if !std::mem::take(&mut self.is_running) {
            return Ok(());
        }
        let sent = self.stream.send(Request::Stop);
        sent.map_err(|error| failed(error.kind(), "stop the readings", error))
    }

    fn interrupt_handle(&self) -> Option<Arc<dyn Interrupt>> {
        Some(Arc::clone(&self.records) as Arc<dyn Interrupt>)
    }

    fn settings(&self) -> BTreeMap<String, String> {
        let mut settings = self.setup.settings();
        settings.extend(self.calibration.settings());
        settings
    }

    fn warnings(&self) -> Vec<String> {
        let mut warnings = self.setup.warnings();
        if self.is_latched {
            warnings.push(
                "a threshold of the box was exceeded and is latched (status 0x80010000); readings stay valid: reset the threshold on the Thresholding page of the box"
                    .to_owned(),
            );
        }
        warnings
    }

    fn tare(&mut self) -> Option<&mut dyn Tare> {
        Some(self)
    }
}

impl Tare for Transducer {
    fn zero(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        let mut zero = self.zero.clone();
        let next = |patience| {
            let seen = self.next(patience)?;
            self.wrench(&seen.what.record)
        };
        zero.take(deadline, next)?;
        self.zero = zero;
        Ok(())
    }
}
