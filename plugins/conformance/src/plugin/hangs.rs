//! Shortens checks of a driver after one of its calls has hung. A check that makes the same call is then skipped, at once or after a short time.

use std::time::Duration;

use taceva_host::Examination;

use super::attempt::{Attempt, attempt};
use super::call_name::{OPENING, is_loading};
use super::probe::Probe;
use super::run;
use crate::report::Outcome;

/// Time limit of the first attempt at a check. In a run, the host ends a plugin whose call without a deadline takes longer.
pub(super) const FIRST: Duration = Duration::from_secs(30);
/// Time for which a call must be pending at the end of the first attempt to count as hanging. Otherwise the check is repeated with its whole time.
const HUNG: Duration = Duration::from_secs(20);
/// Divisor that shortens the time limit of a check for its first attempt after a hang.
const SHORTENED: u32 = 10;
/// Minimum time limit of a shortened attempt. An interpreter needs most of this time to start.
const LEAST: Duration = Duration::from_secs(5);
/// Checks of drivers that open no device.
const OPEN_NOTHING: [&str; 6] = [
    "driver/describes-the-same-twice",
    "driver/describes-every-argument",
    "driver/describe-of-no-driver",
    "driver/open-of-no-driver",
    "driver/keeps-to-the-callers-error",
    "driver/discovers",
];

/// Plugin calls that did not return within the time limit.
#[derive(Debug, Default)]
pub(super) struct Hangs(Vec<Hang>);

/// A plugin call that did not return within the time limit, and the check that made the call.
#[derive(Debug)]
struct Hang {
    /// Key of the driver or estimator, as in [`Probe`]; empty for a call that concerns the plugin as a whole.
    driver: String,
    call: String,
    check: &'static str,
}

impl Hang {
    /// True if the check `name` makes the hanging call before anything else.
    fn stops(&self, name: &str) -> bool {
        is_loading(&self.call) || (self.call == OPENING && !OPEN_NOTHING.contains(&name))
    }

    fn skips(&self) -> Outcome {
        Outcome::Skipped(format!(
            "it did not {} in the check `{}`, which failed",
            self.call, self.check
        ))
    }
}

impl Hangs {
    /// Runs the check `name` on `probe`. Skips a check that would make a hanging call at once. After another hang, the first attempt of a check
    /// without motions has a shorter time limit, because most checks make the same calls.
    pub(super) fn check(
        &mut self,
        examination: &Examination<'_>,
        probe: &Probe,
        name: &'static str,
        limit: Duration,
    ) -> Outcome {
        if let Some(hang) = self.earlier(probe).find(|hang| hang.stops(name)) {
            return hang.skips();
        }
        let first = match self.earlier(probe).next() {
            // A slow motion is not cut short, because nothing halts the device of a killed process.
            _ if probe.moves => limit,
            Some(_) => limit.min(LEAST.max(limit / SHORTENED)),
            // A fit may take long.
            None if name.starts_with("estimator/") => limit,
            None => limit.min(FIRST),
        };
        let tried = attempt(examination, probe, first);
        let Some(call) = tried.hung_in else {
            return tried.outcome;
        };
        if !probe.moves
            && let Some(hang) = self.earlier(probe).find(|hang| hang.call == call)
        {
            return hang.skips();
        }
        if first == limit || (first == FIRST && tried.hung_for >= HUNG && call != run::WHOLE) {
            self.note(probe, call, name);
            return tried.outcome;
        }
        let Attempt {
            outcome, hung_in, ..
        } = attempt(examination, probe, limit);
        if let Some(call) = hung_in {
            self.note(probe, call, name);
        }
        outcome
    }

    /// Hangs recorded so far of the same driver or estimator, or of the plugin as a whole, for example during import.
    fn earlier(&self, probe: &Probe) -> impl Iterator<Item = &Hang> {
        let is_alike = move |hang: &&Hang| hang.driver.is_empty() || hang.driver == probe.driver;
        self.0.iter().filter(is_alike)
    }

    /// Records that the check `name` hung in `call`. Ignores a check that hung outside plugin calls, because other checks are unaffected.
    pub(super) fn note(&mut self, probe: &Probe, call: String, name: &'static str) {
        if call != run::WHOLE {
            self.0.push(Hang {
                driver: match is_loading(&call) {
                    true => String::new(),
                    false => probe.driver.clone(),
                },
                call,
                check: name,
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hang_concerns_checks_of_its_driver_and_only_if_its_call_is_known() {
        let probe = |driver: &str| Probe {
            check: "driver/opens".to_owned(),
            driver: driver.to_owned(),
            arguments: String::new(),
            seed: 0,
            moves: false,
        };
        let [one, other, whole] = ["lab/one", "lab/other", ""].map(probe);
        let mut hangs = Hangs::default();
        hangs.note(&one, run::WHOLE.to_owned(), "driver/opens");
        assert_eq!(hangs.earlier(&one).count(), 0);
        hangs.note(&one, "open the device".to_owned(), "driver/opens");
        let found = [&one, &other].map(|probe| hangs.earlier(probe).count());
        assert_eq!(found, [1, 0]);
        hangs.note(&other, "import its module".to_owned(), "driver/opens");
        let found = [&one, &other].map(|probe| hangs.earlier(probe).count());
        assert_eq!(found, [2, 1]);
        assert_eq!(hangs.earlier(&whole).count(), 1);
    }

    #[test]
    fn a_hang_stops_the_checks_that_begin_with_its_call() {
        let hang = |call: &str| Hang {
            driver: String::new(),
            call: call.to_owned(),
            check: "driver/opens",
        };
        assert!(hang("load its library").stops("driver/discovers"));
        assert!(hang("open the device").stops("sensor/stamps-in-order"));
        assert!(!hang("open the device").stops("driver/discovers"));
        assert!(!hang("read the force").stops("force/reads"));
        for name in OPEN_NOTHING {
            let mut all = crate::plugin::checks().into_iter();
            assert!(all.any(|check| check.name == name), "{name}");
        }
    }
}
