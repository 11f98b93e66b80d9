//! Checks the promises of a plugin, each in a separate confined process with a time limit. Starting a process may take seconds, so one process first
//! runs all checks that leave it unchanged. If that process fails, its checks run again one by one.
//!
//! A check runs in the child process that has loaded the plugin. A check calls the functions of the plugin's tables correctly and incorrectly. Damage
//! to the process does not affect other checks. A trusted plugin is checked in an unconfined process, as in normal use.

mod attempt;
mod call_name;
mod changer_table;
mod clock;
mod driver;
mod estimator;
mod hangs;
mod library;
mod lighting_table;
mod probe;
mod robot_table;
mod run;
mod sensor_table;
mod shared_process;
mod subject;
mod surroundings;

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::time::{Duration, Instant};

use serde::Serialize;
use taceva_core::{
    Changer, DriverError, DriverKey, DriverKind, ForceTransducer, Lighting, Robot, Sensor,
};
use taceva_host::{InProcess, Linked, ModuleToImport, Plugin, PluginHost, Provided, Session};

use self::hangs::Hangs;
use self::probe::Probe;
use self::run::run;
use self::shared_process::held_together;
use self::subject::Subject;
use crate::promise::Unmet;
use crate::report::Outcome;
use crate::trial::{Promise, Tried};
use crate::{changer, force, lighting, robot, sensor};

/// Check of one promise of a plugin.
#[derive(Clone, Copy)]
pub struct Check {
    /// Name: group and promise, separated by `/`.
    pub name: &'static str,
    pub(crate) of: Of,
    pub(crate) test: Test,
}

/// Subject of a check.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Of {
    /// Checked once for the library as a whole.
    Plugin,
    /// Checked for each driver.
    Driver,
    /// Checked for each driver of one kind.
    Kind(DriverKind),
    /// Checked for each estimator.
    Estimator,
}

impl Of {
    /// Creates a check of the subject `self` that calls a function table of the plugin directly.
    const fn check(self, name: &'static str, run: fn(&Subject) -> Result<(), Unmet>) -> Check {
        Check {
            name,
            of: self,
            test: Test::Table(run),
        }
    }
}

/// Test function of a check. The function calls a function table of the plugin, or uses an open device through the device trait of core.
#[derive(Clone, Copy)]
pub(crate) enum Test {
    Table(fn(&Subject) -> Result<(), Unmet>),
    Sensor(DeviceTest<dyn Sensor>),
    Robot(DeviceTest<dyn Robot>),
    Force(DeviceTest<dyn ForceTransducer>),
    Lighting(DeviceTest<dyn Lighting>),
    Changer(DeviceTest<dyn Changer>),
}

type DeviceTest<D> = fn(&Tried<'_, D>) -> Result<(), Unmet>;

impl Test {
    fn run(self, subject: &Subject) -> Result<(), Unmet> {
        match self {
            Test::Table(test) => test(subject),
            Test::Sensor(test) => subject.tries(InProcess::sensor, test),
            Test::Robot(test) => subject.tries(InProcess::robot, test),
            Test::Force(test) => subject.tries(InProcess::force, test),
            Test::Lighting(test) => subject.tries(InProcess::lighting, test),
            Test::Changer(test) => subject.tries(InProcess::changer, test),
        }
    }
}

impl std::fmt::Debug for Check {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name)
    }
}

/// All checks, ordered by group.
pub fn checks() -> Vec<Check> {
    [
        library::CHECKS.to_vec(),
        driver::CHECKS.to_vec(),
        of_kind(
            DriverKind::Sensor,
            sensor::PROMISES,
            Test::Sensor,
            sensor_table::CHECKS,
        ),
        of_kind(
            DriverKind::Robot,
            robot::PROMISES,
            Test::Robot,
            robot_table::CHECKS,
        ),
        of_kind(DriverKind::Force, force::PROMISES, Test::Force, &[]),
        clock::CHECKS.to_vec(),
        of_kind(
            DriverKind::Lighting,
            lighting::PROMISES,
            Test::Lighting,
            lighting_table::CHECKS,
        ),
        of_kind(
            DriverKind::Changer,
            changer::PROMISES,
            Test::Changer,
            changer_table::CHECKS,
        ),
        estimator::CHECKS.to_vec(),
    ]
    .concat()
}

/// Checks of drivers of one `kind`: the `promises` of an open device, and the checks in `table`, which call the plugin's functions directly. A check
/// in `table` replaces the promise of the same name, whose test would examine the host instead of the plugin.
fn of_kind<D: ?Sized>(
    kind: DriverKind,
    promises: &'static [Promise<D>],
    test: fn(DeviceTest<D>) -> Test,
    table: &'static [Check],
) -> Vec<Check> {
    let is_of_table = |name: &str| table.iter().any(|check| check.name == name);
    let of_devices = promises.iter().filter(|(name, _)| !is_of_table(name));
    let of_devices = of_devices.map(|(name, promise)| Check {
        name,
        of: Of::Kind(kind),
        test: test(*promise),
    });
    of_devices.chain(table.iter().copied()).collect()
}

/// Serves as a child process of the host and exits, if this process was started as such a child. The child also runs checks.
///
/// A program that checks plugins calls this function instead of [`taceva_host::main_if_child`].
pub fn main_if_child() {
    taceva_host::main_if_child_examining(run);
}

/// Same as [`taceva_host::serve_as_child`], with the checks of this module.
pub fn serve_as_child(import: impl FnOnce(&ModuleToImport) -> Result<Linked, String>) -> i32 {
    taceva_host::serve_as_child(import, Some(run))
}

/// Request to check a plugin.
#[derive(Clone, Debug)]
pub struct CheckRequest {
    /// Seed of all random draws.
    pub seed: u64,
    /// Name prefixes of the checks to run; empty for all checks.
    pub only: Vec<String>,
    /// Arguments for opening drivers, by driver key. Other drivers open with their defaults.
    pub arguments: BTreeMap<DriverKey, String>,
    /// True if real robots and changers may move.
    pub moves: bool,
    /// Time limit of one check.
    pub limit: Duration,
}

impl Default for CheckRequest {
    fn default() -> CheckRequest {
        CheckRequest {
            seed: 0,
            only: Vec::new(),
            arguments: BTreeMap::new(),
            moves: false,
            limit: Duration::from_secs(60),
        }
    }
}

/// Result of a check.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CheckResult {
    /// Name of the check.
    pub check: &'static str,
    /// Driver or estimator that was checked; `None` for the plugin as a whole.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub subject: Option<String>,
    /// Outcome of the check.
    #[serde(flatten)]
    pub outcome: Outcome,
    /// Duration of the check, s.
    pub took_s: f64,
}

/// Runs the checks of `request` on `plugin`. Calls `begin` with the name of each check that starts, and `tell` with each result.
///
/// # Errors
/// [`DriverError`] if the plugin's library cannot be read.
pub fn check(
    host: &PluginHost,
    plugin: &Plugin,
    request: &CheckRequest,
    begin: &mut dyn FnMut(&str),
    tell: &mut dyn FnMut(CheckResult),
) -> Result<(), DriverError> {
    // A plugin that cannot run at all breaks no promise. Its user gets the reason once.
    let examination = host.examination(plugin)?;
    let is_wanted = |check: &Check| {
        let mut only = request.only.iter();
        request.only.is_empty() || only.any(|begin| check.name.starts_with(begin))
    };
    // First failed check by driver and cause, so each cause fails only one check.
    let mut causes: BTreeMap<(Option<String>, String), &'static str> = BTreeMap::new();
    let wanted: Vec<Check> = checks().into_iter().filter(is_wanted).collect();
    let mut hangs = Hangs::default();
    let held = held_together(&examination, request, &wanted, plugin, &mut hangs, begin);
    for check in wanted {
        for key in subjects(&check, plugin) {
            let begun = Instant::now();
            let (mut outcome, took_s) = match held.get(&(key, check.name)) {
                Some(held) => (held.outcome.clone(), held.took_s),
                None => {
                    begin(check.name);
                    let probe = Probe::of(request, check.name, key);
                    let outcome = hangs.check(&examination, &probe, check.name, request.limit);
                    (outcome, begun.elapsed().as_secs_f64())
                }
            };
            if let Outcome::Failed(why) = &outcome {
                match causes.entry((key.map(ToString::to_string), why.clone())) {
                    Entry::Occupied(first) => {
                        let why = format!("same reason as `{}`, which failed", first.get());
                        outcome = Outcome::Skipped(why);
                    }
                    Entry::Vacant(first) => {
                        first.insert(check.name);
                    }
                }
            }
            tell(CheckResult {
                check: check.name,
                subject: key.map(ToString::to_string),
                outcome,
                took_s,
            });
        }
    }
    Ok(())
}

/// Keys of the drivers or estimators that a check tests; a single `None` for the plugin as a whole.
fn subjects<'a>(check: &Check, plugin: &'a Plugin) -> Vec<Option<&'a DriverKey>> {
    if check.of == Of::Plugin {
        return vec![None];
    }
    let provides = plugin.manifest.provides.iter();
    let fitting = provides.filter(|provided| match (check.of, provided) {
        (Of::Driver, Provided::Driver { .. }) => true,
        (Of::Kind(kind), Provided::Driver { descriptor, .. }) => descriptor.kind() == kind,
        (Of::Estimator, Provided::Estimator(_)) => true,
        _ => false,
    });
    fitting.map(|provided| Some(provided.key())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn there_are_at_least_48_checks_and_no_two_of_one_name() {
        let names: BTreeSet<&str> = checks().iter().map(|check| check.name).collect();
        assert_eq!(names.len(), checks().len());
        assert!(names.len() >= 48, "{}", names.len());
    }
}
