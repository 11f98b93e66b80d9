//! Promises of force transducers. The transducer must be unloaded during the test.

use taceva_core::{Axis, Factory, ForceFacts, ForceTransducer, Wrench, check_wrench};

use crate::promise::{Unmet, broken, expect};
use crate::report::Report;
use crate::stream::{self, Stream, as_declared, started};
use crate::trial::{Promise, Trial, Tried, report};

/// Tests the promises of a force transducer with the settings of `trial`. Nothing may touch the transducer during the test.
pub fn force(factory: &dyn Factory<dyn ForceTransducer>, trial: &Trial) -> Report {
    report(factory, trial, PROMISES)
}

pub(crate) const PROMISES: &[Promise<dyn ForceTransducer>] = &[
    ("force/reads", stream::gives),
    ("force/measures-what-it-says", measures),
    ("force/stamps-in-order", stream::stamps),
    ("force/read-before-start", stream::before_start),
    ("force/starts-and-stops-in-any-order", stream::any_order),
    ("force/passed-deadline", stream::passed_deadline),
    ("force/keeps-deadlines", stream::keeps_deadlines),
    ("force/interrupt-within-50-ms", stream::interrupt),
    ("force/same-readings-of-a-simulation", |tried| {
        stream::repeats(tried, |transducer, deadline| transducer.read(deadline))
    }),
    ("force/tares", tares),
    ("force/numbers-its-readings", numbers),
    ("force/dropped-in-any-state", stream::dropped),
];

type Subject<'a> = Tried<'a, dyn ForceTransducer>;

fn facts<'a>(tried: &'a Subject<'_>) -> Result<&'a ForceFacts, Unmet> {
    let facts = tried.descriptor.force();
    facts.ok_or_else(|| broken("it does not declare itself a force transducer"))
}

/// Readings are finite. Forces are below the declared maximum, and axes that the driver does not declare read 0.
fn measures(tried: &Subject<'_>) -> Result<(), Unmet> {
    let facts = facts(tried)?;
    let mut transducer = started(tried)?;
    let axes = transducer.axes();
    expect(facts.axes == axes, || {
        format!("measures {axes}, declares {}", facts.axes)
    })?;
    for _ in 0..<dyn ForceTransducer>::COUNT {
        let (wrench, _) = tried.reading(transducer.read(tried.trial.deadline))?;
        check_wrench(&wrench).map_err(|error| broken(error.to_string()))?;
        for (axis, value) in Axis::ALL.into_iter().zip(components(&wrench)) {
            let name = axis.name();
            expect(axes.contains(axis) || value.abs() <= 0.0, || {
                format!("{name} is {value}, expected 0 on an axis that is not measured")
            })?;
            let is_force = matches!(axis, Axis::Fx | Axis::Fy | Axis::Fz);
            if let Some(most) = facts.force_max.filter(|_| is_force) {
                expect(value.abs() < most.0, || {
                    format!(
                        "the reading {name} = {value:.1} N reaches the full scale of {most}, where the driver must return an error; if no such force acts, `taceva rig check --weight` names a mistaken unit"
                    )
                })?;
            }
        }
    }
    Ok(())
}

fn components(wrench: &Wrench) -> [f64; 6] {
    let [fx, fy, fz] = wrench.force.map(|force| force.0);
    let [tx, ty, tz] = wrench.torque.map(|torque| torque.0);
    [fx, fy, fz, tx, ty, tz]
}

fn tares(tried: &Subject<'_>) -> Result<(), Unmet> {
    let mut transducer = started(tried)?;
    as_declared("tare", facts(tried)?.tare, transducer.tare().is_some())?;
    for _ in 0..2 {
        if let Some(tare) = transducer.tare() {
            tare.zero(tried.trial.deadline)?;
        }
    }
    tried.reading(transducer.read(tried.trial.deadline))?;
    Ok(())
}

/// Consecutive readings have different numbers if the driver declares numbered readings, and no numbers otherwise.
fn numbers(tried: &Subject<'_>) -> Result<(), Unmet> {
    let declared = facts(tried)?.numbered;
    let mut transducer = started(tried)?;
    let mut before = None;
    for _ in 0..<dyn ForceTransducer>::COUNT {
        tried.reading(transducer.read(tried.trial.deadline))?;
        let number = transducer.sequence();
        as_declared("number its readings", declared, number.is_some())?;
        expect(number != before, || {
            let number = number.unwrap_or_default();
            format!("two readings have the number {number}")
        })?;
        before = number;
    }
    Ok(())
}
