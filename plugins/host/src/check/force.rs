//! Checks of force transducers.

use taceva_core::{Axis, Deadline, DriverKind, ErrorKind, ForceTransducer};

use super::subject::{Ending, PATIENT, Subject, ensure};
use super::{Check, Of, waiting};
use crate::session::Session;

pub(super) const CHECKS: &[Check] = &[
    check("force/reads", reads),
    check("force/measures-what-it-says", measures),
    check("force/stamps-in-order", stamps),
    check("force/read-before-start", before_start),
    check("force/starts-and-stops-in-any-order", any_order),
    check("force/passed-deadline", passed_deadline),
    check("force/keeps-deadlines", keeps_deadlines),
    check("force/interrupt-within-50-ms", interrupt),
    check("force/tares", tares),
    check("force/dropped-in-any-state", dropped),
];

const fn check(name: &'static str, run: fn(&Subject) -> Result<(), Ending>) -> Check {
    Check {
        name,
        of: Of::Kind(DriverKind::Force),
        run,
    }
}

fn open(subject: &Subject) -> Result<Box<dyn ForceTransducer>, Ending> {
    Ok(subject.session.force(subject.key()?, &subject.args()?)?)
}

fn started(subject: &Subject) -> Result<Box<dyn ForceTransducer>, Ending> {
    let mut force = open(subject)?;
    force.start(PATIENT)?;
    Ok(force)
}

fn reads(subject: &Subject) -> Result<(), Ending> {
    let mut force = started(subject)?;
    for _ in 0..20 {
        force.read(PATIENT)?;
    }
    Ok(force.stop()?)
}

fn measures(subject: &Subject) -> Result<(), Ending> {
    let mut force = started(subject)?;
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

fn stamps(subject: &Subject) -> Result<(), Ending> {
    let mut force = started(subject)?;
    let mut last = f64::NEG_INFINITY;
    for _ in 0..20 {
        let (_, stamp) = force.read(PATIENT)?;
        ensure(stamp.valid_s > last, || {
            format!("a reading of {} s after one of {last} s", stamp.valid_s)
        })?;
        last = stamp.valid_s;
    }
    Ok(())
}

/// A reading before the start comes or is refused; either way the device goes on.
fn before_start(subject: &Subject) -> Result<(), Ending> {
    let mut force = open(subject)?;
    match force.read(PATIENT) {
        Err(error) if error.kind() != ErrorKind::InvalidArgument => return Err(error.into()),
        _ => {}
    }
    force.start(PATIENT)?;
    force.read(PATIENT)?;
    Ok(())
}

fn any_order(subject: &Subject) -> Result<(), Ending> {
    let mut force = open(subject)?;
    force.stop()?;
    for _ in 0..3 {
        force.start(PATIENT)?;
        force.start(PATIENT)?;
        force.read(PATIENT)?;
        force.stop()?;
        force.stop()?;
    }
    Ok(())
}

fn passed_deadline(subject: &Subject) -> Result<(), Ending> {
    waiting::passed_deadline(&mut started(subject)?)
}

fn keeps_deadlines(subject: &Subject) -> Result<(), Ending> {
    waiting::keeps_deadlines(&mut started(subject)?)
}

fn interrupt(subject: &Subject) -> Result<(), Ending> {
    waiting::interrupt(&mut started(subject)?)
}

fn tares(subject: &Subject) -> Result<(), Ending> {
    let mut force = started(subject)?;
    let Some(tare) = force.tare() else {
        return Err(Ending::Skipped("it cannot tare".to_owned()));
    };
    tare.zero(PATIENT)?;
    tare.zero(PATIENT)?;
    force.read(PATIENT)?;
    Ok(())
}

fn dropped(subject: &Subject) -> Result<(), Ending> {
    drop(open(subject)?);
    drop(started(subject)?);
    let mut force = started(subject)?;
    let _ = force.read(Deadline::PASSED);
    drop(force);
    let mut force = started(subject)?;
    force.stop()?;
    drop(force);
    drop(started(subject)?);
    Ok(())
}
