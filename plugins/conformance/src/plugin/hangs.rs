//! Checks after a hang. Those that hang in the same call are skipped after a short time.

use std::time::Duration;

use taceva_host::Examination;

use super::attempt::{Attempt, attempt};
use super::probe::Probe;
use crate::report::Outcome;

/// Divisor of the time limit of a check for its first attempt after a hang.
const SHORTENED: u32 = 10;
/// Least time of such an attempt. The start of an interpreter takes most of it.
const LEAST: Duration = Duration::from_secs(5);

/// Calls that did not return, each with the check that found it.
#[derive(Debug, Default)]
pub(super) struct Hangs(Vec<(String, &'static str)>);

impl Hangs {
    /// Runs the check `name` on `probe`. After a hang its first attempt has less time, since most checks make the same calls.
    pub(super) fn check(
        &mut self,
        examination: &Examination<'_>,
        probe: &Probe,
        name: &'static str,
        limit: Duration,
    ) -> Outcome {
        if !self.0.is_empty() {
            let short = limit.min(LEAST.max(limit / SHORTENED));
            let Attempt { outcome, hung_in } = attempt(examination, probe, short);
            let Some(call) = hung_in else {
                return outcome;
            };
            if let Some((_, first)) = self.0.iter().find(|(known, _)| *known == call) {
                return Outcome::Skipped(format!(
                    "it did not {call}, as in `{first}`, which failed"
                ));
            }
        }
        let Attempt { outcome, hung_in } = attempt(examination, probe, limit);
        self.0.extend(hung_in.map(|call| (call, name)));
        outcome
    }
}
