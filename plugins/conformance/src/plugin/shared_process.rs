//! Checks that run together in one process. These checks leave the process unchanged and open no device.

use std::collections::BTreeMap;
use std::time::Instant;

use taceva_core::DriverKey;
use taceva_host::{Examination, Plugin};

use super::attempt::attempt;
use super::call_name::is_loading;
use super::hangs::{FIRST, Hangs};
use super::probe::{BETWEEN, Probe};
use super::{Check, CheckRequest, subjects};
use crate::report::Outcome;

/// Names of the checks of the library and of estimators that share a process.
const NAMES: [&str; 11] = [
    "library/loads",
    "library/needs-what-its-manifest-says",
    "library/unknown-factory",
    "library/stable-factories",
    "library/rigs",
    "estimator/fits-and-predicts",
    "estimator/fits-the-same-twice",
    "estimator/keeps-a-model",
    "estimator/ends-when-cancelled",
    "estimator/predicts-nothing-of-nothing",
    "estimator/predicts-in-threads",
];

/// Outcome of a check in a shared process, and its time, s.
pub(super) struct Held {
    pub(super) outcome: Outcome,
    pub(super) took_s: f64,
}

/// Checks that passed in a shared process, by subject and name. The time of the process is divided evenly among its checks. Checks that are missing
/// here run separately, because a failure hides the results of the other checks. If loading the plugin hung, the first check has this failure.
pub(super) type HeldTogether<'a> = BTreeMap<(Option<&'a DriverKey>, &'static str), Held>;

/// Runs the checks of `wanted` that can share a process, in one process per subject. Calls `begin` with the names of these checks. Adds a hang in
/// loading the plugin to `hangs`.
pub(super) fn held_together<'a>(
    examination: &Examination<'_>,
    request: &CheckRequest,
    wanted: &[Check],
    plugin: &'a Plugin,
    hangs: &mut Hangs,
    begin: &mut dyn FnMut(&str),
) -> HeldTogether<'a> {
    let mut by_subject: BTreeMap<Option<&DriverKey>, Vec<&'static str>> = BTreeMap::new();
    for check in wanted.iter().filter(|check| NAMES.contains(&check.name)) {
        for key in subjects(check, plugin) {
            by_subject.entry(key).or_default().push(check.name);
        }
    }
    let mut held = HeldTogether::new();
    for (key, names) in by_subject {
        let Some(count) = u32::try_from(names.len()).ok().filter(|count| *count > 1) else {
            continue;
        };
        let probe = Probe::of(request, &names.join(BETWEEN), key);
        begin(&names.join(", "));
        let begun = Instant::now();
        let limit = match key {
            None => request.limit.min(FIRST),
            Some(_) => request.limit,
        };
        let tried = attempt(examination, &probe, limit);
        let took = begun.elapsed();
        if tried.outcome == Outcome::Passed {
            let took_s = (took / count).as_secs_f64();
            held.extend(names.into_iter().map(|name| {
                let outcome = Outcome::Passed;
                ((key, name), Held { outcome, took_s })
            }));
        } else if let Some(call) = tried.hung_in.filter(|call| is_loading(call)) {
            hangs.note(&probe, call, names[0]);
            let (outcome, took_s) = (tried.outcome, took.as_secs_f64());
            held.insert((key, names[0]), Held { outcome, took_s });
            // Every further check loads the plugin too.
            break;
        }
    }
    held
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plugin::{Of, checks};

    #[test]
    fn every_name_is_that_of_a_check_without_a_device() {
        for name in NAMES {
            let check = checks().into_iter().find(|check| check.name == name);
            let of = check.map(|check| check.of);
            assert!(matches!(of, Some(Of::Plugin | Of::Estimator)), "{name}");
            assert!(!name.contains(BETWEEN));
        }
    }
}
