//! Subject of a check: a loaded plugin, and one of its drivers or estimators.

use std::sync::Arc;
use std::time::{Duration, Instant};

use taceva_abi as abi;
use taceva_core::{
    ArgError, Args, Deadline, Descriptor, DescriptorError, Device, DriverError, DriverKey,
    DriverKind, DriverSource, Factory, Rig,
};
use taceva_host::bare::{
    ArgList, Entry, Opened, RigHandle, Source, Table, call, open, pending_call,
};
use taceva_host::{Failure, InProcess, Library, Manifest, Provided, Session};

use super::call_name::LOADING;
use super::probe::Probe;
use super::surroundings::Surroundings;
use crate::promise::{Kinded, Unmet, broken, skipped};
use crate::trial::{NO_DEVICE, Trial, Tried, unopened};

/// Deadline of a call that should succeed.
pub(super) const PATIENT: Deadline = Deadline::after(Duration::from_secs(5));
/// Time within which an interrupt or a halt must act.
pub(super) const AT_ONCE: Duration = Duration::from_millis(50);
/// Time by which a force reading may exceed its deadline. A guard waits 20 ms for a reading, and its turn may take 50 ms.
pub(super) const OVERRUN: Duration = Duration::from_millis(20);
/// Time limit of calls that should return at once, also on a busy machine.
pub(super) const SOON: Duration = Duration::from_millis(500);

/// Greatest number of times that one check opens a real device.
const REAL_OPENINGS: usize = 3;

/// A loaded plugin, and one of its drivers or estimators.
pub(crate) struct Subject {
    pub(super) probe: Probe,
    pub(super) library: Arc<Library>,
    pub(super) source: Source,
    pub(super) manifest: Manifest,
    pub(super) session: InProcess,
    /// State of the process before the plugin was loaded.
    pub(super) before: Surroundings,
    key: Option<DriverKey>,
}

impl Subject {
    pub(super) fn new(source: Source, manifest: &Manifest, probe: Probe) -> Result<Subject, Unmet> {
        let failed = |error: &dyn std::fmt::Display| broken(error.to_string());
        let before = Surroundings::now();
        let loading = pending_call::begin(LOADING);
        let library = source
            .load(Some(manifest), Box::new(|_, _, _| {}))
            .map_err(|error| failed(&error.problem()))?;
        drop(loading);
        let session = InProcess::open(&library)?;
        let key = match probe.driver.as_str() {
            "" => None,
            driver => Some(driver.parse().map_err(|error| failed(&error))?),
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

    /// Key of the checked driver or estimator. Fails for a check of the plugin as a whole.
    pub(super) fn key(&self) -> Result<&DriverKey, Unmet> {
        let none = || broken("this check needs a driver");
        self.key.as_ref().ok_or_else(none)
    }

    pub(super) fn entry(&self) -> Result<&Entry, Unmet> {
        let key = self.key()?;
        let entry = self.library.any(key);
        entry.ok_or_else(|| Unmet::Broken(format!("the library does not provide `{key}`")))
    }

    /// Description of the driver in the manifest.
    pub(super) fn descriptor(&self) -> Result<&Descriptor, Unmet> {
        match &self.entry()?.provided {
            Provided::Driver { descriptor, .. } => Ok(descriptor),
            _ => Err(broken("it is not a driver")),
        }
    }

    /// Arguments for opening the device: the given arguments, and the declared defaults of all other arguments.
    pub(super) fn args(&self) -> Result<Args, Unmet> {
        let args = Args::parse(self.entry()?.arguments(), &self.probe.arguments);
        args.map_err(|error| {
            let key = &self.probe.driver;
            let argument = match &error {
                ArgError::Missing { key, .. } => key.as_str(),
                _ => "KEY",
            };
            Unmet::Skipped(format!("{error}: give it with `--with {key}:{argument}=…`"))
        })
    }

    pub(super) fn list(&self) -> Result<ArgList, Unmet> {
        Ok(ArgList::new(&self.args()?, self.entry()?.arguments()))
    }

    /// Description that the library returns for the driver and its arguments.
    pub(super) fn said(&self) -> Result<Descriptor, Unmet> {
        Ok(self.session.describe(self.key()?, &self.args()?)?)
    }

    /// Opens the device in a new rig, for direct calls of its function table.
    pub(super) fn open<T: Table>(&self) -> Result<Opened<T>, Unmet> {
        let rig = RigHandle::open(&self.library)?;
        self.opened(open(&rig, self.entry()?, &self.list()?))
    }

    /// Returns the opened device, or the reason why it did not open.
    pub(super) fn opened<T>(&self, opened: Result<T, DriverError>) -> Result<T, Unmet> {
        opened.map_err(|error| self.not_opened(error))
    }

    /// Reason why a device did not open. If a real device is missing, the promise is skipped.
    fn not_opened(&self, error: DriverError) -> Unmet {
        match unopened(error, self.is_real()) {
            Unmet::Skipped(why) => Unmet::Skipped(self.with_place(&why)),
            broken => broken,
        }
    }

    /// True if the driver controls a real device, which wears out.
    pub(super) fn is_real(&self) -> bool {
        let descriptor = self.descriptor();
        descriptor.is_ok_and(|descriptor| descriptor.source() == DriverSource::Real)
    }

    /// Number of times that a check may open a device: `simulated`, or fewer for a real device, which opens slowly and wears out.
    pub(super) fn openings(&self, simulated: usize) -> usize {
        if self.is_real() {
            simulated.min(REAL_OPENINGS)
        } else {
            simulated
        }
    }

    /// Tests a promise of the trait `D` on the checked driver. `open` opens a device in a new rig.
    pub(super) fn tries<D: Device + ?Sized>(
        &self,
        open: OpenIn<D>,
        test: fn(&Tried<'_, D>) -> Result<(), Unmet>,
    ) -> Result<(), Unmet> {
        // A missing argument is reported with the option of the command.
        self.args()?;
        let driver = InLibrary {
            library: &self.library,
            session: &self.session,
            descriptor: self.descriptor()?,
            open,
        };
        let overrun = match driver.descriptor.kind() {
            // A simulated device has its own clock, and may compute for long.
            _ if !self.is_real() => SOON,
            DriverKind::Force => OVERRUN,
            _ => AT_ONCE,
        };
        let trial = Trial {
            deadline: PATIENT,
            at_once: SOON,
            acts_within: AT_ONCE,
            overrun,
            moves: self.probe.moves || driver.descriptor.source() == DriverSource::Simulated,
            ..Trial::with_arguments(&*self.probe.arguments)
        };
        let tried = Tried::new(&driver, &trial).and_then(|tried| test(&tried));
        match tried {
            Err(Unmet::Skipped(why)) if why.starts_with(NO_DEVICE) => {
                Err(Unmet::Skipped(self.with_place(&why)))
            }
            tried => tried,
        }
    }

    /// Skips a promise that moves a device, unless the device is simulated or the user gave `--move`.
    pub(super) fn may_move(&self) -> Result<(), Unmet> {
        if self.probe.moves || self.descriptor()?.source() == DriverSource::Simulated {
            return Ok(());
        }
        Err(skipped("it would move a real device; `--move` allows it"))
    }

    /// Appends the command option that selects a device to `why`.
    fn with_place(&self, why: &str) -> String {
        let key = &self.probe.driver;
        format!("{why}; name a device with `--with {key}:…`")
    }
}

/// Function that opens a device in a session.
pub(super) type OpenIn<D> = fn(&InProcess, &DriverKey, &Args) -> Result<Box<D>, DriverError>;

/// Factory of a driver of the checked library.
struct InLibrary<'a, D: ?Sized> {
    library: &'a Arc<Library>,
    session: &'a InProcess,
    descriptor: &'a Descriptor,
    open: OpenIn<D>,
}

impl<D: Device + ?Sized> Factory<D> for InLibrary<'_, D> {
    fn descriptor(&self) -> &Descriptor {
        self.descriptor
    }

    fn describe(&self, args: &Args) -> Result<Descriptor, DescriptorError> {
        // Another check tests the description by the library. Without it, this check uses the manifest.
        let said = self.session.describe(self.descriptor.key(), args);
        Ok(said.unwrap_or_else(|_| self.descriptor.clone()))
    }

    fn open(&self, args: &Args, _: &mut Rig) -> Result<Box<D>, DriverError> {
        let session = InProcess::open(self.library)?;
        (self.open)(&session, self.descriptor.key(), args)
    }
}

/// Runs a direct call of a plugin function. Returns the failure that the plugin reports.
pub(super) fn bare(run: impl FnOnce(*mut abi::Error) -> abi::Status) -> Result<(), Failure> {
    call(|error| run(std::ptr::from_mut(error)))
}

/// Runs `run`; returns its result and duration.
pub(super) fn timed<T>(run: impl FnOnce() -> T) -> (T, Duration) {
    let begun = Instant::now();
    let result = run();
    (result, begun.elapsed())
}

/// Random numbers from a seed by xorshift64*, sufficient for garbage data.
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

/// Writable memory of this process, bytes. A memory leak increases this number.
pub(super) fn writable_memory() -> Result<u64, Unmet> {
    let maps = std::fs::read_to_string("/proc/self/maps")
        .map_err(|error| Unmet::Skipped(format!("/proc/self/maps: {error}")))?;
    let length = |line: &str| -> Option<u64> {
        let (range, rest) = line.split_once(' ')?;
        let (from, to) = range.split_once('-')?;
        let [from, to] = [from, to].map(|digits| u64::from_str_radix(digits, 16).ok());
        rest.starts_with("rw").then_some(to? - from?)
    };
    Ok(maps.lines().filter_map(length).sum())
}

impl From<Failure> for Unmet {
    fn from(failure: Failure) -> Unmet {
        Unmet::Broken(failure.message())
    }
}

impl Kinded for Failure {
    fn of_kind(&self) -> taceva_core::ErrorKind {
        self.kind()
    }
}
