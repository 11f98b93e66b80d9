//! What the suites have in common: a driver to open again and again, and words for what it did wrong.

use std::fmt;
use std::time::{Duration, Instant};

use taceva_core::{
    Args, Descriptor, DescriptorError, DriverError, DriverSource, ErrorKind, Factory, Rig, Stamp,
};

use super::Trial;
use super::report::{Check, Outcome, Report};
use taceva_core::contained;

/// A driver under test.
pub(super) struct Bench<'a, D: ?Sized> {
    factory: &'a dyn Factory<D>,
    args: Args,
    /// What it says of itself with these arguments.
    pub(super) descriptor: Descriptor,
    pub(super) trial: &'a Trial,
}

/// Why a check does not hold.
#[derive(Debug)]
pub(super) enum Unmet {
    /// The driver broke its contract.
    Broken(String),
    /// The check has nothing to say about this driver.
    Inapplicable(String),
}

/// What must hold, and the test of it.
pub(super) type Test<D> = (&'static str, fn(&Bench<'_, D>) -> Result<(), Unmet>);

/// Runs every test; a panic of the driver is a failure of that test alone.
pub(super) fn run<D: ?Sized>(factory: &dyn Factory<D>, trial: &Trial, tests: &[Test<D>]) -> Report {
    let mut report = Report {
        driver: factory.descriptor().key().clone(),
        checks: Vec::new(),
    };
    let prepared =
        contained(|| prepare(factory, trial)).unwrap_or_else(|panic| Err(panicked(panic)));
    let mut note = |name, outcome: Result<(), Unmet>| {
        report.checks.push(Check {
            name,
            outcome: match outcome {
                Ok(()) => Outcome::Passed,
                Err(Unmet::Broken(why)) => Outcome::Failed(why),
                Err(Unmet::Inapplicable(why)) => Outcome::Skipped(why),
            },
        });
    };
    const PREPARED: &str = "takes the arguments of the trial";
    match prepared {
        Err(unmet) => note(PREPARED, Err(unmet)),
        Ok(bench) => {
            note(PREPARED, Ok(()));
            for (name, test) in tests {
                let outcome = contained(|| test(&bench));
                note(name, outcome.unwrap_or_else(|panic| Err(panicked(panic))));
            }
        }
    }
    report
}

fn prepare<'a, D: ?Sized>(
    factory: &'a dyn Factory<D>,
    trial: &'a Trial,
) -> Result<Bench<'a, D>, Unmet> {
    let args = factory
        .descriptor()
        .args(&trial.arguments)
        .map_err(|error| broken(error.to_string()))?;
    let descriptor = factory
        .describe(&args)
        .map_err(|error: DescriptorError| broken(error.to_string()))?;
    if descriptor.key() != factory.descriptor().key() {
        return Err(broken(format!(
            "describes itself as `{}`",
            descriptor.key()
        )));
    }
    Ok(Bench {
        factory,
        args,
        descriptor,
        trial,
    })
}

fn panicked(message: String) -> Unmet {
    Unmet::Broken(format!("panicked: {message}"))
}

/// The driver broke its contract.
pub(super) fn broken(why: impl Into<String>) -> Unmet {
    Unmet::Broken(why.into())
}

/// Breaks off with `why` unless `holds`.
pub(super) fn expect(holds: bool, why: impl FnOnce() -> String) -> Result<(), Unmet> {
    if holds { Ok(()) } else { Err(broken(why())) }
}

impl From<DriverError> for Unmet {
    fn from(error: DriverError) -> Unmet {
        Unmet::Broken(format!("{error} ({})", error.kind()))
    }
}

impl<D: ?Sized> Bench<'_, D> {
    /// The device, opened in a rig of its own.
    pub(super) fn open(&self) -> Result<Box<D>, Unmet> {
        Ok(self.factory.open(&self.args, &mut Rig::new())?)
    }

    /// A reading that should be there; a recording may have ended.
    pub(super) fn reading<T>(&self, read: Result<T, DriverError>) -> Result<T, Unmet> {
        read.map_err(|error| {
            let is_recording = self.descriptor.source() == DriverSource::Recorded;
            if is_recording && error.kind() == ErrorKind::EndOfStream {
                return Unmet::Inapplicable("the recording ended too early".to_owned());
            }
            Unmet::from(error)
        })
    }

    /// What `call` gives, if it returns at once.
    pub(super) fn at_once<T>(&self, doing: &str, call: impl FnOnce() -> T) -> Result<T, Unmet> {
        let began = Instant::now();
        let result = call();
        self.was_at_once(doing, began.elapsed())?;
        Ok(result)
    }

    /// Breaks off if `took` is no "at once".
    pub(super) fn was_at_once(&self, doing: &str, took: Duration) -> Result<(), Unmet> {
        let most = self.trial.at_once;
        expect(took <= most, || {
            format!("{doing} took {took:?}, expected at most {most:?}")
        })
    }
}

/// Breaks off unless `result` is an error of one of `kinds`.
pub(super) fn refused<T: fmt::Debug>(
    doing: &str,
    result: Result<T, DriverError>,
    kinds: &[ErrorKind],
) -> Result<(), Unmet> {
    let expected = || {
        let kinds: Vec<String> = kinds.iter().map(ToString::to_string).collect();
        kinds.join(" or ")
    };
    match result {
        Err(error) if kinds.contains(&error.kind()) => Ok(()),
        Err(error) => Err(broken(format!(
            "{doing} gave {} ({error}), expected {}",
            error.kind(),
            expected()
        ))),
        Ok(value) => Err(broken(format!(
            "{doing} gave {value:?}, expected {}",
            expected()
        ))),
    }
}

/// Breaks off unless `result` is a success or an error of kind `otherwise`.
pub(super) fn answered<T: fmt::Debug>(
    doing: &str,
    result: Result<T, DriverError>,
    otherwise: ErrorKind,
) -> Result<(), Unmet> {
    match result {
        Ok(_) => Ok(()),
        error => refused(doing, error, &[otherwise]),
    }
}

/// Breaks off unless the times are finite, in order, and nothing arrived before it was true.
pub(super) fn in_order(stamps: &[Stamp]) -> Result<(), Unmet> {
    for stamp in stamps {
        let received = stamp.received_s;
        expect(
            stamp.valid_s.is_finite() && received.is_none_or(f64::is_finite),
            || format!("a stamp of {} s, received at {received:?}", stamp.valid_s),
        )?;
        expect(
            received.is_none_or(|received| received >= stamp.valid_s),
            || {
                format!(
                    "received at {received:?} before it was true at {} s",
                    stamp.valid_s
                )
            },
        )?;
    }
    for pair in stamps.windows(2) {
        expect(pair[0].valid_s < pair[1].valid_s, || {
            format!(
                "a stamp of {} s after one of {} s",
                pair[1].valid_s, pair[0].valid_s
            )
        })?;
    }
    Ok(())
}
