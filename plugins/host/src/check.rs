//! Whether a plugin keeps its promises: many small checks, each in a confined process of its own with a time limit.
//!
//! A check runs beside the plugin, in the child, and calls the functions of its tables as a host would, and as no host should. Whatever it
//! does to its process, the others go on. A plugin that its user trusts is checked as it runs: in a process that nothing is kept from.

mod changer;
mod driver;
mod estimator;
mod force;
mod lending;
mod library;
mod lighting;
mod probe;
mod robot;
mod run;
mod sensor;
mod streaming;
mod subject;
mod surroundings;

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::os::fd::OwnedFd;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use serde::Serialize;
use taceva_core::{Args, DriverError, DriverKey, DriverKind, ErrorKind};

use self::probe::Probe;
pub(crate) use self::run::run;
use self::subject::{Ending, Subject};
use crate::child::{CALL, Child, ChildError, Fate, no_port};
use crate::grant::{self, Grant};
use crate::host::PluginHost;
use crate::host::code::ReadCode;
use crate::library::Log;
use crate::manifest::Provided;
use crate::search::Plugin;

/// One thing that a plugin promises.
#[derive(Clone, Copy)]
pub struct Check {
    /// Its name: the group, and what holds.
    pub name: &'static str,
    /// What it is about.
    pub(crate) of: Of,
    pub(crate) run: fn(&Subject) -> Result<(), Ending>,
}

/// What a check is about.
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

impl std::fmt::Debug for Check {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name)
    }
}

/// Every check, group by group.
pub fn checks() -> impl Iterator<Item = &'static Check> {
    [
        library::CHECKS,
        driver::CHECKS,
        sensor::CHECKS,
        lending::CHECKS,
        robot::CHECKS,
        force::CHECKS,
        lighting::CHECKS,
        changer::CHECKS,
        estimator::CHECKS,
    ]
    .into_iter()
    .flatten()
}

/// How a plugin is checked.
#[derive(Clone, Debug)]
pub struct CheckRequest {
    /// The seed of everything that is drawn at random.
    pub seed: u64,
    /// The checks whose names begin with one of these; all, where there is none.
    pub only: Vec<String>,
    /// The arguments of drivers by their keys; a driver that is not named is opened with its defaults.
    pub arguments: BTreeMap<DriverKey, String>,
    /// Whether robots and changers that are not simulated may be moved.
    pub moves: bool,
    /// How long one check may take.
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

/// In the message of a device that did not open.
const NOT_OPENED: &str = ": cannot open the device: ";

/// How a check ended.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(tag = "outcome", content = "why", rename_all = "lowercase")]
pub enum CheckOutcome {
    /// The promise holds.
    Passed,
    /// It does not, for this reason.
    Failed(String),
    /// It could not be looked at, for this reason.
    Skipped(String),
}

/// A check that was made.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CheckResult {
    /// Its name.
    pub check: &'static str,
    /// The driver or estimator that was looked at; the plugin as a whole without.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub subject: Option<String>,
    /// How it ended.
    #[serde(flatten)]
    pub outcome: CheckOutcome,
    /// How long it took, in seconds.
    pub took_s: f64,
}

impl PluginHost {
    /// Makes the checks of `request` on `plugin`, and calls `tell` with the result of each.
    ///
    /// # Errors
    /// [`DriverError`] if its library cannot even be read.
    pub fn check(
        &self,
        plugin: &Plugin,
        request: &CheckRequest,
        tell: &mut dyn FnMut(CheckResult),
    ) -> Result<(), DriverError> {
        let whole = plugin.id().as_driver();
        // One that cannot be run at all breaks no promise: its user hears why, once.
        let code = plugin.read(&whole)?;
        plugin.child(&code, &whole, self.children())?;
        let is_wanted = |check: &&Check| {
            let mut only = request.only.iter();
            request.only.is_empty() || only.any(|begin| check.name.starts_with(begin))
        };
        // Of each driver, why a check failed or could not be made, and which one was the first: a cause is told once.
        let mut causes: BTreeMap<(Option<String>, String), &'static str> = BTreeMap::new();
        for check in checks().filter(is_wanted) {
            for key in subjects(check, plugin) {
                let probe = Probe {
                    check: check.name.to_owned(),
                    driver: key.map(ToString::to_string).unwrap_or_default(),
                    arguments: key
                        .and_then(|key| request.arguments.get(key))
                        .cloned()
                        .unwrap_or_default(),
                    seed: request.seed,
                    moves: request.moves,
                };
                let begun = Instant::now();
                let mut outcome = self.made(plugin, (&code, &probe), request.limit);
                let cause = match &outcome {
                    CheckOutcome::Failed(why) => Some((why.clone(), "failed")),
                    CheckOutcome::Skipped(why) => Some((why.clone(), "was skipped")),
                    CheckOutcome::Passed => None,
                };
                if let Some((why, how)) = cause {
                    match causes.entry((key.map(ToString::to_string), why)) {
                        Entry::Occupied(first) => {
                            let why = format!("for the reason why `{}` {how}", first.get());
                            outcome = CheckOutcome::Skipped(why);
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
                    took_s: begun.elapsed().as_secs_f64(),
                });
            }
        }
        Ok(())
    }

    /// One check, in a child.
    fn made(
        &self,
        plugin: &Plugin,
        (code, probe): (&ReadCode, &Probe),
        limit: Duration,
    ) -> CheckOutcome {
        let (grant, arguments) = match self.grant_of(plugin, &probe.driver, &probe.arguments) {
            Ok(granted) => granted,
            Err(error) => return CheckOutcome::Failed(error.to_string()),
        };
        let probe = &Probe {
            arguments,
            ..probe.clone()
        };
        let files = probe.sealed().map(|probe| -> Vec<OwnedFd> { vec![probe] });
        let spec = plugin.child(code, &plugin.id().as_driver(), self.children());
        let (mut spec, files) = match (spec, files) {
            (Ok(spec), Ok(files)) => (spec, files),
            (Err(error), _) => return CheckOutcome::Failed(error.to_string()),
            (_, Err(error)) => return CheckOutcome::Failed(error.to_string()),
        };
        spec.files.extend(files);
        // A check does what nobody should; a plugin that does not live through it may start again.
        spec.quarantine = None;
        spec.confinement.needs = grant.reached.iter().cloned().collect();
        if let Some(why) = no_port(&spec.confinement.needs) {
            return CheckOutcome::Failed(why);
        }
        spec.confinement.is_trusted = self.config().trust(plugin).is_some();
        let call = Arc::new(Mutex::new(String::new()));
        spec.log = Some(noting(&call));
        spec.patience.start = limit;
        let child = match Child::start(spec) {
            Ok(child) => child,
            Err(error) => {
                let call = call.lock().unwrap_or_else(PoisonError::into_inner);
                let outcome = ended(hung_in(error, &call));
                // A plugin may take what it may not reach for what is not there, which would be no failure.
                return match &outcome {
                    // What its arguments name is not allowed, so the name of a machine was not looked up for it either: one cause, whatever it is
                    // that the plugin noticed.
                    CheckOutcome::Failed(why) | CheckOutcome::Skipped(why)
                        if grant.lacks_bound()
                            && (why.starts_with(subject::NO_DEVICE)
                                || why.contains(NOT_OPENED)) =>
                    {
                        CheckOutcome::Failed(format!("{}; {}", grant::NOT_ALLOWED, grant.withheld))
                    }
                    CheckOutcome::Failed(why) | CheckOutcome::Skipped(why) => {
                        let explained = grant.withheld.explain(why);
                        explained.map_or(outcome, CheckOutcome::Failed)
                    }
                    CheckOutcome::Passed => outcome,
                };
            }
        };
        let life = Arc::clone(child.life());
        drop(child);
        let printed = life.watch.printed();
        if probe.check == library::QUIET && !printed.is_empty() {
            return CheckOutcome::Failed(format!("it printed {printed:?}"));
        }
        CheckOutcome::Passed
    }
}

impl PluginHost {
    /// What a check of `driver` may reach: what a device may that is opened with `arguments`; and these, with addresses for names of machines.
    fn grant_of(
        &self,
        plugin: &Plugin,
        driver: &str,
        arguments: &str,
    ) -> Result<(Grant, String), DriverError> {
        let mut drivers = plugin.manifest.drivers();
        let descriptor = drivers.find(|descriptor| descriptor.key().as_str() == driver);
        let args = descriptor.and_then(|descriptor| {
            let args = Args::parse(descriptor.arguments(), arguments).ok()?;
            Some((descriptor, args))
        });
        let Some((descriptor, args)) = args else {
            // The check itself says which arguments it lacks.
            return Ok((self.config().grant(plugin), arguments.to_owned()));
        };
        let (key, specs) = (descriptor.key(), descriptor.arguments());
        let grant = self.config().grant_for(plugin, key, &args)?;
        let is_trusted = self.config().trust(plugin).is_some();
        if is_trusted || !grant.is_bound || grant.lacks_bound() {
            return Ok((grant, arguments.to_owned()));
        }
        let args = grant::resolved(plugin, key, specs, &args)?;
        let given = specs.iter().filter_map(|spec| {
            let value = args.get(&spec.key)?.to_string();
            Some(format!("{}={}", spec.key, value.replace(';', ";;")))
        });
        Ok((grant, given.collect::<Vec<_>>().join(";")))
    }
}

/// A log that notes in `call` which call a check says that it is in.
fn noting(call: &Arc<Mutex<String>>) -> Log {
    let call = Arc::clone(call);
    Box::new(move |_, target, message| {
        if target == CALL {
            message.clone_into(&mut call.lock().unwrap_or_else(PoisonError::into_inner));
        }
    })
}

/// The error of a check that was ended, in whose place the call stands that did not return, where it is known.
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

fn ended(error: ChildError) -> CheckOutcome {
    match error {
        ChildError::Refused {
            kind: ErrorKind::Unsupported,
            why,
            ..
        } if why.starts_with(run::SKIPPED) => {
            CheckOutcome::Skipped(why[run::SKIPPED.len()..].to_owned())
        }
        ChildError::Refused { why, .. } => CheckOutcome::Failed(why),
        ChildError::Gone { fate, printed, .. } if printed.is_empty() => {
            CheckOutcome::Failed(format!("the process ended: {fate}"))
        }
        ChildError::Gone { fate, printed, .. } => {
            CheckOutcome::Failed(format!("the process ended: {fate}; it printed {printed:?}"))
        }
        other => CheckOutcome::Failed(other.to_string()),
    }
}

/// The keys that a check is made on; one nothing for the plugin as a whole.
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
        let names: BTreeSet<&str> = checks().map(|check| check.name).collect();
        assert_eq!(names.len(), checks().count());
        assert!(names.len() >= 48, "{}", names.len());
    }
}
