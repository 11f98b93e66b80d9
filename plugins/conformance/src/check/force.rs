//! Checks of force transducers.

use std::sync::Arc;

use taceva_core::{Axis, Deadline, DriverError, DriverKind, ForceTransducer, Interrupt, Stamp};

use super::streaming::{self, Streams};
use super::subject::{Ending, PATIENT, Subject, ensure};
use super::{Check, Of};
use taceva_host::Session;

pub(super) const CHECKS: &[Check] = &[
    check("force/reads", streaming::gives::<Transducer>),
    check("force/measures-what-it-says", measures),
    check("force/stamps-in-order", streaming::stamps::<Transducer>),
    check(
        "force/read-before-start",
        streaming::before_start::<Transducer>,
    ),
    check(
        "force/starts-and-stops-in-any-order",
        streaming::any_order::<Transducer>,
    ),
    check(
        "force/passed-deadline",
        streaming::passed_deadline::<Transducer>,
    ),
    check(
        "force/keeps-deadlines",
        streaming::keeps_deadlines::<Transducer>,
    ),
    check(
        "force/interrupt-within-50-ms",
        streaming::interrupt::<Transducer>,
    ),
    check("force/tares", tares),
    check("force/numbers-its-readings", numbers),
    check(
        "force/dropped-in-any-state",
        streaming::dropped::<Transducer>,
    ),
];

const fn check(name: &'static str, run: fn(&Subject) -> Result<(), Ending>) -> Check {
    Check {
        name,
        of: Of::Kind(DriverKind::Force),
        run,
    }
}

type Transducer = Box<dyn ForceTransducer>;

impl Streams for Transducer {
    const ITEM: &'static str = "reading";
    const COUNT: usize = 20;

    fn open(subject: &Subject) -> Result<Transducer, Ending> {
        subject.opened(subject.session.force(subject.key()?, &subject.args()?))
    }

    fn begin(&mut self) -> Result<(), DriverError> {
        self.start(PATIENT)
    }

    fn end(&mut self) -> Result<(), DriverError> {
        self.stop()
    }

    fn next(&mut self, deadline: Deadline) -> Result<Stamp, DriverError> {
        Ok(self.read(deadline)?.1)
    }

    fn interrupter(&self) -> Option<Arc<dyn Interrupt>> {
        self.interrupt_handle()
    }
}

fn measures(subject: &Subject) -> Result<(), Ending> {
    let mut force = Transducer::started(subject)?;
    let said = subject.said()?;
    let facts = said
        .force()
        .ok_or_else(|| Ending::Broken("it says it is no transducer".to_owned()))?;
    let (wrench, _) = force.read(PATIENT)?;
    let greatest = facts.force_max.map_or(f64::INFINITY, |most| most.0);
    for (value, axis) in wrench.force.iter().zip([Axis::Fx, Axis::Fy, Axis::Fz]) {
        ensure(value.0.abs() <= greatest, || {
            format!(
                "{} is {value}, beyond the {greatest} N that it measures",
                axis.name()
            )
        })?;
    }
    ensure(force.axes() == facts.axes, || {
        "other axes than it says".to_owned()
    })
}

fn tares(subject: &Subject) -> Result<(), Ending> {
    let mut force = Transducer::started(subject)?;
    let Some(tare) = force.tare() else {
        return Err(Ending::Skipped("it cannot tare".to_owned()));
    };
    tare.zero(PATIENT)?;
    tare.zero(PATIENT)?;
    force.read(PATIENT)?;
    Ok(())
}

/// Each reading has a number of its own, if it says so; and none if it does not.
fn numbers(subject: &Subject) -> Result<(), Ending> {
    let mut force = Transducer::started(subject)?;
    let said = subject.said()?;
    let is_numbered = said.force().is_some_and(|facts| facts.numbered);
    if !is_numbered {
        let why = "it does not number its readings";
        return Err(Ending::Skipped(why.to_owned()));
    }
    let mut before = None;
    for _ in 0..Transducer::COUNT {
        force.read(PATIENT)?;
        let number = force.sequence();
        ensure(number.is_some(), || "a reading without a number".to_owned())?;
        ensure(number != before, || {
            format!(
                "two readings have the number {}",
                number.unwrap_or_default()
            )
        })?;
        before = number;
    }
    Ok(())
}
