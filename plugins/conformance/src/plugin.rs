//! Promises of a plugin. Each is checked in a separate confined process with a time limit. A start may take seconds, so one process first tries all
//! harmless checks together. If it fails, they run separately.
//!
//! A check runs in the child, in the plugin's process. It calls the functions of the plugin's tables as a host would, and as no host should. The
//! other checks continue even if it damages its process. A trusted plugin is checked in an unconfined process, as in normal use.

mod changer_table;
mod driver;
mod estimator;
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
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use serde::Serialize;
use taceva_core::{
    Changer, DriverError, DriverKey, DriverKind, ErrorKind, ForceTransducer, Lighting, Robot,
    Sensor,
};
use taceva_host::bare::CALL;
use taceva_host::{
    ChildError, Examination, ExaminationError, ExaminationOrder, Fate, InProcess, Linked, Log,
    ModuleToImport, NOT_ALLOWED, Plugin, PluginHost, Provided, Session,
};

use self::probe::Probe;
use self::run::run;
use self::shared_process::held_together;
use self::subject::Subject;
use crate::promise::Unmet;
use crate::report::Outcome;
use crate::trial::{NO_DEVICE, Promise, Tried};
use crate::{changer, force, lighting, robot, sensor};

/// One promise of a plugin.
#[derive(Clone, Copy)]
pub struct Check {
    /// Name: the group, and the promise.
    pub name: &'static str,
    pub(crate) of: Of,
    pub(crate) test: Test,
}

/// The subject of a check.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Of {
    /// The library as a whole.
    Plugin,
    /// Each driver.
    Driver,
    /// Each driver of a kind.
    Kind(DriverKind),
    /// Each estimator.
    Estimator,
}

/// Test of a check: on a bare table, or on a device like any driver of its kind.
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

/// All checks, by group.
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

/// Promises of a kind, and those of its table. A promise of the table replaces one with the same name, because the host would answer in place of the
/// plugin.
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

/// Serves as the child of a host and exits, if this process was started as one. Such a child also runs checks.
///
/// A program that checks plugins calls this instead of [`taceva_host::main_if_child`].
pub fn main_if_child() {
    taceva_host::main_if_child_examining(run);
}

/// As [`taceva_host::serve_as_child`], with checks of the module.
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
    /// Arguments of drivers, by key. Other drivers are opened with their defaults.
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

/// Part of the message of a device that did not open.
const NOT_OPENED: &str = ": cannot open the device: ";

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
    /// Duration, seconds.
    pub took_s: f64,
}

/// Runs the checks of `request` on `plugin`. Calls `tell` with each result.
///
/// # Errors
/// [`DriverError`] if the plugin's library cannot be read.
pub fn check(
    host: &PluginHost,
    plugin: &Plugin,
    request: &CheckRequest,
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
    let held = held_together(&examination, request, &wanted, plugin);
    for check in wanted {
        for key in subjects(&check, plugin) {
            let begun = Instant::now();
            let (mut outcome, took_s) = match held.get(&(key, check.name)) {
                Some(took_s) => (Outcome::Passed, *took_s),
                None => {
                    let probe = Probe::of(request, check.name, key);
                    let outcome = made(&examination, &probe, request.limit);
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

/// Runs one check in a child.
fn made(examination: &Examination<'_>, probe: &Probe, limit: Duration) -> Outcome {
    let call = Arc::new(Mutex::new(String::new()));
    let order = ExaminationOrder {
        driver: &probe.driver,
        arguments: &probe.arguments,
        limit,
        log: noting(&call),
    };
    let printed = examination.run(order, |arguments| {
        let probe = Probe {
            arguments,
            ..probe.clone()
        };
        serde_json::to_vec(&probe).expect("texts and numbers")
    });
    let (error, withheld, lacks_bound) = match printed {
        Ok(printed) if probe.check == library::QUIET && !printed.is_empty() => {
            return Outcome::Failed(format!("it printed {printed:?}"));
        }
        Ok(_) => return Outcome::Passed,
        Err(ExaminationError::Unready(why)) => return Outcome::Failed(why),
        Err(ExaminationError::Child {
            error,
            withheld,
            lacks_bound,
        }) => (error, withheld, lacks_bound),
    };
    let call = call.lock().unwrap_or_else(PoisonError::into_inner);
    let outcome = ended(hung_in(*error, &call));
    // A plugin may report a withheld resource as missing, which would not count as a failure.
    match &outcome {
        // Its arguments name a resource without permission, so host names were not resolved either. This counts as one cause, for any report of the
        // plugin.
        Outcome::Failed(why) | Outcome::Skipped(why)
            if lacks_bound && (why.starts_with(NO_DEVICE) || why.contains(NOT_OPENED)) =>
        {
            Outcome::Failed(format!("{NOT_ALLOWED}; {withheld}"))
        }
        Outcome::Failed(why) | Outcome::Skipped(why) => {
            let explained = withheld.explain(why);
            explained.map_or(outcome, Outcome::Failed)
        }
        Outcome::Passed => outcome,
    }
}

/// Log that stores the pending call of a check in `call`.
fn noting(call: &Arc<Mutex<String>>) -> Log {
    let call = Arc::clone(call);
    Box::new(move |_, target, message| {
        if target == CALL {
            message.clone_into(&mut call.lock().unwrap_or_else(PoisonError::into_inner));
        }
    })
}

/// Error of a check that was killed. Names the hanging call, if known.
fn hung_in(error: ChildError, call: &str) -> ChildError {
    match error {
        ChildError::Gone {
            plugin,
            fate: Fate::Late { after, .. },
            printed,
        } if !call.is_empty() => ChildError::Gone {
            plugin,
            fate: Fate::Late {
                doing: call.to_owned(),
                after,
            },
            printed,
        },
        other => other,
    }
}

fn ended(error: ChildError) -> Outcome {
    match error {
        ChildError::Refused {
            kind: ErrorKind::Unsupported,
            why,
            ..
        } if why.starts_with(run::SKIPPED) => {
            Outcome::Skipped(why[run::SKIPPED.len()..].to_owned())
        }
        ChildError::Refused { why, .. } => Outcome::Failed(why),
        ChildError::Gone { fate, printed, .. } if printed.is_empty() => {
            Outcome::Failed(format!("the process ended: {fate}"))
        }
        ChildError::Gone { fate, printed, .. } => {
            Outcome::Failed(format!("the process ended: {fate}; it printed {printed:?}"))
        }
        other => Outcome::Failed(other.to_string()),
    }
}

/// Driver or estimator keys of a check; a single `None` for the plugin as a whole.
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
