//! Trial of a driver: settings, and functions that open and test the device.

use std::sync::{Arc, mpsc};
use std::thread;
use std::time::{Duration, Instant};

use taceva_core::{
    Args, Deadline, Descriptor, DescriptorError, DriverError, DriverSource, ErrorKind, Factory,
    Interrupt, Millimetre, Rig, contained,
};

use crate::promise::{Unmet, broken, expect, skipped};
use crate::report::{Outcome, Report, Tested};

/// Settings for testing a driver on its device.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// Arguments for opening the device, as a user writes them after the driver key and a colon.
    pub arguments: String,
    /// Deadline of calls that should succeed, on the clock of the device.
    pub deadline: Deadline,
    /// Time limit of a call that should return at once, on the clock of this machine.
    pub at_once: Duration,
    /// Time limit from an interrupt or a halt until the call in progress has returned.
    pub acts_within: Duration,
    /// Time by which most of several short calls may exceed their deadline, on the clock of this machine.
    pub overrun: Duration,
    /// Distance that a robot moves away from the gel, mm.
    pub travel: Millimetre,
    /// True if the trial may move robots and changers; otherwise promises with motions are skipped.
    pub moves: bool,
}

impl Trial {
    /// Creates a trial with `arguments`. Calls that should succeed have 1 s, calls that should return at once have 0.5 s. A robot travels 0.5 mm.
    pub fn with_arguments(arguments: impl Into<String>) -> Trial {
        Trial {
            arguments: arguments.into(),
            deadline: Deadline::after(Duration::from_secs(1)),
            at_once: Duration::from_millis(500),
            acts_within: Duration::from_millis(500),
            overrun: Duration::from_millis(500),
            travel: Millimetre(0.5),
            moves: true,
        }
    }
}

impl Default for Trial {
    fn default() -> Trial {
        Trial::with_arguments("")
    }
}

/// Name (`kind/words`) and test function of one promise of devices with the trait `D`.
pub(crate) type Promise<D> = (&'static str, fn(&Tried<'_, D>) -> Result<(), Unmet>);

/// Driver under test.
pub(crate) struct Tried<'a, D: ?Sized> {
    factory: &'a dyn Factory<D>,
    args: Args,
    /// Description of the driver for the arguments of the trial.
    pub(crate) descriptor: Descriptor,
    pub(crate) trial: &'a Trial,
}

/// Tests every promise of the driver. A panic of the driver breaks only the promise under test.
pub(crate) fn report<D: ?Sized>(
    factory: &dyn Factory<D>,
    trial: &Trial,
    promises: &[Promise<D>],
) -> Report {
    const PREPARED: &str = "driver/takes-its-arguments";
    let caught = |tested: Result<Result<(), Unmet>, String>| match tested {
        Ok(Ok(())) => Outcome::Passed,
        Ok(Err(Unmet::Broken(why))) => Outcome::Failed(why),
        Ok(Err(Unmet::Skipped(why))) => Outcome::Skipped(why),
        Err(panic) => Outcome::Failed(format!("panicked: {panic}")),
    };
    let mut report = Report {
        driver: factory.descriptor().key().clone(),
        promises: Vec::new(),
    };
    let prepared = contained(|| Tried::new(factory, trial));
    let (tried, outcome) = match prepared {
        Ok(Ok(tried)) => (Some(tried), Outcome::Passed),
        Ok(Err(unmet)) => (None, caught(Ok(Err(unmet)))),
        Err(panic) => (None, caught(Err(panic))),
    };
    let name = PREPARED;
    report.promises.push(Tested { name, outcome });
    if let Some(tried) = tried {
        for (name, test) in promises {
            let outcome = caught(contained(|| test(&tried)));
            report.promises.push(Tested { name, outcome });
        }
    }
    report
}

impl<'a, D: ?Sized> Tried<'a, D> {
    /// Prepares the test of the driver of `factory`: parses the arguments of `trial` and describes the driver.
    pub(crate) fn new(factory: &'a dyn Factory<D>, trial: &'a Trial) -> Result<Self, Unmet> {
        let of_trial = factory.descriptor();
        let args = of_trial.args(&trial.arguments);
        let args = args.map_err(|error| broken(error.to_string()))?;
        let descriptor = factory.describe(&args);
        let descriptor = descriptor.map_err(|error: DescriptorError| broken(error.to_string()))?;
        expect(descriptor.key() == of_trial.key(), || {
            format!(
                "it describes itself as `{}`, expected `{}`",
                descriptor.key(),
                of_trial.key()
            )
        })?;
        Ok(Tried {
            factory,
            args,
            descriptor,
            trial,
        })
    }

    /// Opens the device in a new rig.
    pub(crate) fn open(&self) -> Result<Box<D>, Unmet> {
        let is_real = self.descriptor.source() == DriverSource::Real;
        let opened = self.factory.open(&self.args, &mut Rig::new());
        opened.map_err(|error| unopened(error, is_real))
    }

    /// Returns a reading that the test needs. Skips the promise if the device replays a recording, and the recording has ended.
    pub(crate) fn reading<T>(&self, read: Result<T, DriverError>) -> Result<T, Unmet> {
        let is_recording = self.descriptor.source() == DriverSource::Recorded;
        read.map_err(|error| match error.kind() {
            ErrorKind::EndOfStream if is_recording => skipped("the recording ended too early"),
            _ => error.into(),
        })
    }

    /// Skips a promise about simulations unless the driver is simulated.
    pub(crate) fn is_simulated(&self) -> Result<(), Unmet> {
        match self.descriptor.source() {
            DriverSource::Simulated => Ok(()),
            source => Err(skipped(format!(
                "its readings are {source}, but this check needs simulated readings"
            ))),
        }
    }

    /// Skips a promise that moves a device, unless the trial allows it.
    pub(crate) fn may_move(&self) -> Result<(), Unmet> {
        if self.trial.moves {
            return Ok(());
        }
        Err(skipped("it would move a real device; `--move` allows it"))
    }

    /// Returns the result of `call`. Fails unless `call` returns within [`Trial::at_once`].
    pub(crate) fn at_once<T>(&self, doing: &str, call: impl FnOnce() -> T) -> Result<T, Unmet> {
        self.in_time(doing, Duration::ZERO, call)
    }

    /// Returns the result of `call`. Fails unless `call` returns within `given` plus [`Trial::at_once`].
    pub(crate) fn in_time<T>(
        &self,
        doing: &str,
        given: Duration,
        call: impl FnOnce() -> T,
    ) -> Result<T, Unmet> {
        let begun = Instant::now();
        let result = call();
        was_within(doing, begun.elapsed(), given + self.trial.at_once)?;
        Ok(result)
    }
}

/// First words of the reason for skipping a promise, if no device is connected.
pub(crate) const NO_DEVICE: &str = "no device is connected";

/// Reason why a device did not open. If a real device is missing, the promise is skipped.
pub(crate) fn unopened(error: DriverError, is_real: bool) -> Unmet {
    match error.kind() {
        ErrorKind::NotFound | ErrorKind::Disconnected if is_real => {
            skipped(format!("{NO_DEVICE}: {error}"))
        }
        _ => error.into(),
    }
}

/// Fails if the call described by `doing` took longer than `most`.
pub(crate) fn was_within(doing: &str, took: Duration, most: Duration) -> Result<(), Unmet> {
    expect(took <= most, || {
        format!("{doing} took {took:.1?}, expected at most {most:?}")
    })
}

/// Thread that interrupts a call 20 ms after [`Alarm::set`].
pub(crate) struct Alarm {
    rung: mpsc::Receiver<Instant>,
}

impl Alarm {
    /// Starts the thread that calls `interrupt`. Skips the promise if the device has no interrupt.
    pub(crate) fn set(interrupt: Option<Arc<dyn Interrupt>>) -> Result<Alarm, Unmet> {
        let interrupt = interrupt.ok_or_else(|| skipped("it cannot be interrupted"))?;
        let (sender, rung) = mpsc::channel();
        thread::spawn(move || {
            thread::sleep(Duration::from_millis(20));
            let now = Instant::now();
            interrupt.interrupt();
            // No receiver exists if the promise is already broken.
            let _ = sender.send(now);
        });
        Ok(Alarm { rung })
    }

    /// Time at which the interrupt was called; `None` until this call has returned.
    pub(crate) fn rang(&self) -> Option<Instant> {
        self.rung.try_recv().ok()
    }

    /// Waits until the interrupt call has returned, and returns the time of the call.
    pub(crate) fn wait(&self) -> Result<Instant, Unmet> {
        let rung = self.rung.recv_timeout(Duration::from_secs(10));
        rung.map_err(|_| broken("the interrupt did not return within 10 s"))
    }
}
