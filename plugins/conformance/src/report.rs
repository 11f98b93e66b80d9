//! Outcomes of the promises of a driver.

use std::fmt;

use serde::Serialize;
use taceva_core::DriverKey;

/// Outcomes of all promises of one driver, in order.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// Tested driver.
    pub driver: DriverKey,
    /// Outcome of each promise.
    pub promises: Vec<Tested>,
}

/// Promise of a driver, with the outcome of its test.
#[derive(Clone, Debug, PartialEq)]
pub struct Tested {
    /// Name: kind and promise, separated by `/`.
    pub name: &'static str,
    /// Outcome of the promise.
    pub outcome: Outcome,
}

/// Outcome of a promise.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(tag = "outcome", content = "why", rename_all = "lowercase")]
pub enum Outcome {
    /// The driver kept the promise.
    Passed,
    /// The driver broke the promise, for this reason.
    Failed(String),
    /// The promise was not tested or does not apply, for this reason.
    Skipped(String),
}

impl Report {
    /// True if at least one promise passed and none failed.
    pub fn passed(&self) -> bool {
        let some = |wanted: fn(&Outcome) -> bool| {
            let mut outcomes = self.promises.iter().map(|tested| &tested.outcome);
            outcomes.any(wanted)
        };
        some(|outcome| *outcome == Outcome::Passed)
            && !some(|outcome| matches!(outcome, Outcome::Failed(_)))
    }

    /// Outcome of the promise `name`; `None` if the suite lacks it.
    pub fn outcome(&self, name: &str) -> Option<&Outcome> {
        let tested = self.promises.iter().find(|tested| tested.name == name);
        tested.map(|tested| &tested.outcome)
    }

    /// Names of the broken promises.
    pub fn failures(&self) -> Vec<&'static str> {
        let failed = |tested: &&Tested| matches!(tested.outcome, Outcome::Failed(_));
        let failed = self.promises.iter().filter(failed);
        failed.map(|tested| tested.name).collect()
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.driver)?;
        for Tested { name, outcome } in &self.promises {
            match outcome {
                Outcome::Passed => writeln!(f, "  holds    {name}")?,
                Outcome::Failed(why) => writeln!(f, "  broken   {name}: {why}")?,
                Outcome::Skipped(why) => writeln!(f, "  skipped  {name}: {why}")?,
            }
        }
        Ok(())
    }
}
