//! Shortens checks of a driver after one of its calls has hung. A check that hangs in the same call is then skipped after a short time.

use std::time::Duration;

use taceva_host::Examination;

use super::attempt::{Attempt, attempt};
use super::probe::Probe;
use super::run;
use crate::report::Outcome;

/// Divisor that shortens the time limit of a check for its first attempt after a hang.
const SHORTENED: u32 = 10;
/// Minimum time limit of a shortened attempt. An interpreter needs most of this time to start.
const LEAST: Duration = Duration::from_secs(5);

/// Plugin calls that did not return within the time limit.
#[derive(Debug, Default)]
pub(super) struct Hangs(Vec<Hang>);

/// A plugin call that did not return within the time limit, and the check that made the call.
#[derive(Debug)]
struct Hang {
    /// Key of the driver or estimator, as in [`Probe`].
    driver: String,
    call: String,
    check: &'static str,
}

impl Hangs {
    /// Runs the check `name` on `probe`. After a hang, the first attempt of a check without motions has a shorter time limit, because most checks
    /// make the same calls.
    pub(super) fn check(
        &mut self,
        examination: &Examination<'_>,
        probe: &Probe,
        name: &'static str,
        limit: Duration,
    ) -> Outcome {
        // A slow motion is not cut short, because nothing halts the device of a killed process.
        if !probe.moves && self.earlier(probe).next().is_some() {
            let short = limit.min(LEAST.max(limit / SHORTENED));
            let Attempt { outcome, hung_in } = attempt(examination, probe, short);
            let Some(call) = hung_in else {
                return outcome;
            };
            if let Some(first) = self.earlier(probe).find(|hang| hang.call == call) {
                return Outcome::Skipped(format!(
                    "it did not {call}, as in `{}`, which failed",
                    first.check
                ));
            }
        }
        let Attempt { outcome, hung_in } = attempt(examination, probe, limit);
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
    fn note(&mut self, probe: &Probe, call: String, name: &'static str) {
        if call != run::WHOLE {
            self.0.push(Hang {
                driver: probe.driver.clone(),
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
        hangs.note(&whole, "import its module".to_owned(), "library/loads");
        let found = [&one, &other].map(|probe| hangs.earlier(probe).count());
        assert_eq!(found, [2, 1]);
    }
}
