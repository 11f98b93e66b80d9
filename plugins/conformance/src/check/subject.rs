//! What a check looks at: a loaded plugin, and one of its drivers.

use std::sync::Arc;
use std::time::{Duration, Instant};

use taceva_abi as abi;
use taceva_core::{
    Args, Deadline, Descriptor, DriverError, DriverKey, DriverSource, ErrorKind, ModelError,
};

use super::probe::Probe;
use super::surroundings::Surroundings;
use taceva_host::Failure;
use taceva_host::InProcess;
use taceva_host::Library;
use taceva_host::Session;
use taceva_host::bare::{ArgList, Table, call};
use taceva_host::bare::{Entry, Source};
use taceva_host::bare::{Opened, RigHandle, open};
use taceva_host::{Manifest, Provided};

/// How a check ended that did not pass.
#[derive(Debug)]
pub(crate) enum Ending {
    /// The promise does not hold.
    Broken(String),
    /// It could not be looked at.
    Skipped(String),
}

impl From<DriverError> for Ending {
    fn from(error: DriverError) -> Ending {
        Ending::Broken(error.to_string())
    }
}

impl From<ModelError> for Ending {
    fn from(error: ModelError) -> Ending {
        Ending::Broken(error.to_string())
    }
}

impl From<Failure> for Ending {
    fn from(failure: Failure) -> Ending {
        Ending::Broken(failure.message())
    }
}

/// Fails a check unless `holds`.
pub(super) fn ensure(holds: bool, why: impl FnOnce() -> String) -> Result<(), Ending> {
    if holds {
        Ok(())
    } else {
        Err(Ending::Broken(why()))
    }
}

/// The time that a call gets which should succeed.
pub(super) const PATIENT: Deadline = Deadline::after(Duration::from_secs(5));
/// Within which an interrupt and a halt act.
pub(super) const AT_ONCE: Duration = Duration::from_millis(50);
/// Within which whatever should return at once does, on a busy machine.
pub(super) const SOON: Duration = Duration::from_millis(500);

/// How the reason begins for which a check was skipped that needs a device.
pub(super) const NO_DEVICE: &str = "no device is there";

/// How often one check opens a real device.
const REAL_OPENINGS: usize = 3;

/// A loaded plugin, and one of its drivers or estimators.
pub(crate) struct Subject {
    pub(super) probe: Probe,
    pub(super) library: Arc<Library>,
    pub(super) source: Source,
    pub(super) manifest: Manifest,
    pub(super) session: InProcess,
    /// As it was before the plugin was loaded.
    pub(super) before: Surroundings,
    key: Option<DriverKey>,
}

impl Subject {
    pub(super) fn new(
        source: Source,
        manifest: &Manifest,
        probe: Probe,
    ) -> Result<Subject, Ending> {
        let broken = |error: &dyn std::fmt::Display| Ending::Broken(error.to_string());
        let before = Surroundings::now();
        let library = source
            .load(Some(manifest), Box::new(|_, _, _| {}))
            .map_err(|error| broken(&error.problem()))?;
        let session = InProcess::open(&library)?;
        let key = match probe.driver.as_str() {
            "" => None,
            driver => Some(driver.parse().map_err(|error| broken(&error))?),
        };
        Ok(Subject {
            probe,
            library,
            source,
            manifest: manifest.clone(),
            session,
            before,
            key,
        })
    }

    /// The key of the driver or estimator.
    pub(super) fn key(&self) -> Result<&DriverKey, Ending> {
        let none = || Ending::Broken("this check is of a driver".to_owned());
        self.key.as_ref().ok_or_else(none)
    }

    pub(super) fn entry(&self) -> Result<&Entry, Ending> {
        let key = self.key()?;
        let entry = self.library.any(key);
        entry.ok_or_else(|| Ending::Broken(format!("`{key}` is not there")))
    }

    /// What the manifest says of the driver.
    pub(super) fn descriptor(&self) -> Result<&Descriptor, Ending> {
        match &self.entry()?.provided {
            Provided::Driver { descriptor, .. } => Ok(descriptor),
            _ => Err(Ending::Broken("it is no driver".to_owned())),
        }
    }

    /// The arguments to open it with: those that were given, or what it declares.
    pub(super) fn args(&self) -> Result<Args, Ending> {
        let args = Args::parse(self.entry()?.arguments(), &self.probe.arguments);
        args.map_err(|error| {
            let key = &self.probe.driver;
            Ending::Skipped(format!("{error}: give it with `--with {key}:…`"))
        })
    }

    pub(super) fn list(&self) -> Result<ArgList, Ending> {
        Ok(ArgList::new(&self.args()?, self.entry()?.arguments()))
    }

    /// What the library says of the driver with its arguments.
    pub(super) fn said(&self) -> Result<Descriptor, Ending> {
        Ok(self.session.describe(self.key()?, &self.args()?)?)
    }

    /// The device with its bare table, in a rig of its own.
    pub(super) fn open<T: Table>(&self) -> Result<Opened<T>, Ending> {
        let rig = RigHandle::open(&self.library)?;
        self.opened(open(&rig, self.entry()?, &self.list()?))
    }

    /// A device that opened, or why it did not.
    pub(super) fn opened<T>(&self, opened: Result<T, DriverError>) -> Result<T, Ending> {
        opened.map_err(|error| self.not_opened(error))
    }

    /// Why a device did not open: one that exists, and is not here, keeps no promise and breaks none.
    fn not_opened(&self, error: DriverError) -> Ending {
        let is_away = [ErrorKind::NotFound, ErrorKind::Disconnected].contains(&error.kind());
        let is_absent = is_away && self.is_real();
        if is_absent {
            let key = &self.probe.driver;
            return Ending::Skipped(format!(
                "{NO_DEVICE}: {error}; `--with {key}:…` says where one is"
            ));
        }
        error.into()
    }

    /// Whether its devices are made of matter, and wear.
    pub(super) fn is_real(&self) -> bool {
        let descriptor = self.descriptor();
        descriptor.is_ok_and(|descriptor| descriptor.source() == DriverSource::Real)
    }

    /// How often a device is opened that `simulated` times would be if it were none: a real one takes seconds and wears.
    pub(super) fn openings(&self, simulated: usize) -> usize {
        if self.is_real() {
            simulated.min(REAL_OPENINGS)
        } else {
            simulated
        }
    }

    /// Skips a check that moves a robot, unless it is a simulation or its user allowed it.
    pub(super) fn may_move(&self) -> Result<(), Ending> {
        if self.probe.moves || self.descriptor()?.source() == DriverSource::Simulated {
            return Ok(());
        }
        let why = "it would move a real robot; `--move` allows it";
        Err(Ending::Skipped(why.to_owned()))
    }
}

/// Calls a function of a bare table; the failure is what the plugin says.
pub(super) fn bare(run: impl FnOnce(*mut abi::Error) -> abi::Status) -> Result<(), Failure> {
    call(|error| run(std::ptr::from_mut(error)))
}

/// Expects a failure of one of `kinds`.
pub(super) fn expect_failure<T, E: Into<Ending> + KindOf>(
    what: &str,
    result: Result<T, E>,
    kinds: &[ErrorKind],
) -> Result<(), Ending> {
    match result {
        Err(error) if kinds.contains(&error.kind_of()) => Ok(()),
        Err(error) => {
            let kind = error.kind_of();
            Err(Ending::Broken(format!(
                "{what} gave `{kind}`, expected {}",
                words(kinds)
            )))
        }
        Ok(_) => Err(Ending::Broken(format!(
            "{what} succeeded, expected {}",
            words(kinds)
        ))),
    }
}

fn words(kinds: &[ErrorKind]) -> String {
    let words: Vec<String> = kinds.iter().map(|kind| format!("`{kind}`")).collect();
    words.join(" or ")
}

/// An error that has a kind.
pub(super) trait KindOf {
    fn kind_of(&self) -> ErrorKind;
}

impl KindOf for DriverError {
    fn kind_of(&self) -> ErrorKind {
        self.kind()
    }
}

impl KindOf for Failure {
    fn kind_of(&self) -> ErrorKind {
        self.kind()
    }
}

impl KindOf for ModelError {
    fn kind_of(&self) -> ErrorKind {
        self.kind()
    }
}

/// How long `run` takes.
pub(super) fn timed<T>(run: impl FnOnce() -> T) -> (T, Duration) {
    let begun = Instant::now();
    let result = run();
    (result, begun.elapsed())
}

/// A number drawn from a seed: xorshift64*, enough for rubbish.
pub(super) struct Draw(u64);

impl Draw {
    pub(super) fn new(seed: u64) -> Draw {
        Draw(seed ^ 0x9e37_79b9_7f4a_7c15)
    }

    pub(super) fn next(&mut self) -> u64 {
        let mut state = self.0 | 1;
        state ^= state >> 12;
        state ^= state << 25;
        state ^= state >> 27;
        self.0 = state;
        state.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    pub(super) fn bytes(&mut self, length: usize) -> Vec<u8> {
        (0..length).map(|_| self.next().to_le_bytes()[7]).collect()
    }
}

/// Memory of this process that may be written, in bytes: what a leak adds to.
pub(super) fn writable_memory() -> Result<u64, Ending> {
    let maps = std::fs::read_to_string("/proc/self/maps")
        .map_err(|error| Ending::Skipped(format!("/proc/self/maps: {error}")))?;
    let length = |line: &str| -> Option<u64> {
        let (range, rest) = line.split_once(' ')?;
        let (from, to) = range.split_once('-')?;
        let [from, to] = [from, to].map(|digits| u64::from_str_radix(digits, 16).ok());
        rest.starts_with("rw").then_some(to? - from?)
    };
    Ok(maps.lines().filter_map(length).sum())
}
