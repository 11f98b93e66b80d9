//! The suite for force transducers.

use taceva_core::{
    Axis, Deadline, DriverSource, ErrorKind, Factory, ForceFacts, ForceTransducer, Wrench,
    check_wrench,
};

use super::bench::{Bench, Test, Unmet, answered, broken, expect, in_order, refused, run};
use super::{Report, Trial};

/// Tries a force transducer, which nothing should press meanwhile.
pub fn force(factory: &dyn Factory<dyn ForceTransducer>, trial: &Trial) -> Report {
    run(factory, trial, TESTS)
}

type Subject<'a> = Bench<'a, dyn ForceTransducer>;

const TESTS: &[Test<dyn ForceTransducer>] = &[
    (
        "measures the components it declares",
        measures_declared_axes,
    ),
    (
        "gives readings in the order of their stamps",
        reads_in_order,
    ),
    (
        "gives finite numbers within its range, and 0 where it measures nothing",
        reads_numbers,
    ),
    (
        "answers a deadline that has passed at once",
        keeps_deadlines,
    ),
    ("starts and stops in any order", starts_and_stops),
    ("gives back what it held when it is dropped", opens_again),
    (
        "gives the same readings to the same arguments",
        repeats_itself,
    ),
    (
        "calls the load zero if it declares that it can",
        tares_as_declared,
    ),
    (
        "numbers its readings if it declares that it does",
        numbers_as_declared,
    ),
];

/// How many readings a check looks at.
const READINGS: usize = 8;

fn measures_declared_axes(bench: &Subject<'_>) -> Result<(), Unmet> {
    let (declared, measured) = (facts(bench)?.axes, bench.open()?.axes());
    expect(declared == measured, || {
        format!("measures {measured}, declares {declared}")
    })
}

fn reads_in_order(bench: &Subject<'_>) -> Result<(), Unmet> {
    let mut transducer = started(bench)?;
    let mut stamps = Vec::new();
    for _ in 0..READINGS {
        stamps.push(bench.reading(transducer.read(bench.trial.deadline))?.1);
    }
    in_order(&stamps)
}

fn reads_numbers(bench: &Subject<'_>) -> Result<(), Unmet> {
    let force_max = facts(bench)?.force_max;
    let mut transducer = started(bench)?;
    let axes = transducer.axes();
    for _ in 0..READINGS {
        let (wrench, _) = bench.reading(transducer.read(bench.trial.deadline))?;
        check_wrench(&wrench).map_err(|error| broken(error.to_string()))?;
        for (axis, value) in Axis::ALL.into_iter().zip(components(&wrench)) {
            let name = axis.name();
            expect(axes.contains(axis) || value.abs() <= 0.0, || {
                format!("{name} is {value}, yet it is not measured")
            })?;
            let is_force = matches!(axis, Axis::Fx | Axis::Fy | Axis::Fz);
            if let Some(most) = force_max.filter(|_| is_force) {
                expect(value.abs() < most.0, || {
                    format!("{name} is {value} N, expected an error at or beyond {most}")
                })?;
            }
        }
    }
    Ok(())
}

fn keeps_deadlines(bench: &Subject<'_>) -> Result<(), Unmet> {
    let mut transducer = started(bench)?;
    for _ in 0..READINGS {
        let read = bench.at_once("reading without time", || transducer.read(Deadline::PASSED))?;
        answered("reading without time", read, ErrorKind::Timeout)?;
    }
    bench.reading(transducer.read(bench.trial.deadline))?;
    Ok(())
}

fn starts_and_stops(bench: &Subject<'_>) -> Result<(), Unmet> {
    let deadline = bench.trial.deadline;
    let mut transducer = bench.open()?;
    transducer.stop()?;
    transducer.start(deadline)?;
    transducer.start(deadline)?;
    let (_, before) = bench.reading(transducer.read(deadline))?;
    transducer.stop()?;
    transducer.stop()?;
    let stopped = bench.at_once("reading while stopped", || {
        transducer.read(Deadline::PASSED)
    })?;
    if stopped.is_err() {
        let kinds = [ErrorKind::InvalidArgument, ErrorKind::Timeout];
        refused("reading while stopped", stopped, &kinds)?;
    }
    transducer.start(deadline)?;
    let (_, after) = bench.reading(transducer.read(deadline))?;
    in_order(&[before, after])
}

fn opens_again(bench: &Subject<'_>) -> Result<(), Unmet> {
    for _ in 0..2 {
        let mut transducer = started(bench)?;
        bench.reading(transducer.read(bench.trial.deadline))?;
    }
    Ok(())
}

fn repeats_itself(bench: &Subject<'_>) -> Result<(), Unmet> {
    if bench.descriptor.source() != DriverSource::Simulated {
        let source = bench.descriptor.source();
        return Err(Unmet::Inapplicable(format!("its readings are {source}")));
    }
    let readings = || -> Result<Vec<_>, Unmet> {
        let mut transducer = started(bench)?;
        (0..READINGS)
            .map(|_| bench.reading(transducer.read(bench.trial.deadline)))
            .collect()
    };
    let (first, second) = (readings()?, readings()?);
    expect(first == second, || "two runs differ".to_owned())
}

fn tares_as_declared(bench: &Subject<'_>) -> Result<(), Unmet> {
    let declared = facts(bench)?.tare;
    let mut transducer = started(bench)?;
    match (transducer.tare(), declared) {
        (None, false) => Err(Unmet::Inapplicable("it cannot".to_owned())),
        (None, true) => Err(broken("cannot, yet declares it")),
        (Some(_), false) => Err(broken("can, yet does not declare it")),
        (Some(tare), true) => {
            tare.zero(bench.trial.deadline)?;
            bench.reading(transducer.read(bench.trial.deadline))?;
            Ok(())
        }
    }
}

fn numbers_as_declared(bench: &Subject<'_>) -> Result<(), Unmet> {
    let declared = facts(bench)?.numbered;
    let mut transducer = started(bench)?;
    let mut before = None;
    for _ in 0..READINGS {
        bench.reading(transducer.read(bench.trial.deadline))?;
        let number = transducer.sequence();
        match (number, declared) {
            (None, true) => return Err(broken("a reading has no number, yet it declares them")),
            (Some(_), false) => return Err(broken("numbers readings, yet does not declare it")),
            (None, false) => return Err(Unmet::Inapplicable("it does not".to_owned())),
            (Some(_), true) => {}
        }
        expect(number != before, || {
            format!(
                "two readings have the number {}",
                number.unwrap_or_default()
            )
        })?;
        before = number;
    }
    Ok(())
}

fn facts<'a>(bench: &'a Subject<'_>) -> Result<&'a ForceFacts, Unmet> {
    let facts = bench.descriptor.force();
    facts.ok_or_else(|| broken("does not declare itself a force transducer"))
}

fn started(bench: &Subject<'_>) -> Result<Box<dyn ForceTransducer>, Unmet> {
    let mut transducer = bench.open()?;
    transducer.start(bench.trial.deadline)?;
    Ok(transducer)
}

fn components(wrench: &Wrench) -> [f64; 6] {
    let [fx, fy, fz] = wrench.force.map(|force| force.0);
    let [tx, ty, tz] = wrench.torque.map(|torque| torque.0);
    [fx, fy, fz, tx, ty, tz]
}
