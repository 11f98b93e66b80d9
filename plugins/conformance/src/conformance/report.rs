//! What came out of a suite.

use std::fmt;

use taceva_core::DriverKey;

/// The checks of a suite, in their order.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// The driver that was tried.
    pub driver: DriverKey,
    /// What came out of each check.
    pub checks: Vec<Check>,
}

/// One check.
#[derive(Clone, Debug, PartialEq)]
pub struct Check {
    /// What must hold.
    pub name: &'static str,
    /// Whether it does.
    pub outcome: Outcome,
}

/// Whether a check holds.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// It does.
    Passed,
    /// It does not, and why.
    Failed(String),
    /// It says nothing about this driver, and why.
    Skipped(String),
}

impl Report {
    /// Whether no check failed and at least one passed.
    pub fn passed(&self) -> bool {
        let some =
            |wanted: fn(&Outcome) -> bool| self.checks.iter().any(|check| wanted(&check.outcome));
        some(|outcome| matches!(outcome, Outcome::Passed))
            && !some(|outcome| matches!(outcome, Outcome::Failed(_)))
    }

    /// What came out of the check called `name`.
    pub fn outcome(&self, name: &str) -> Option<&Outcome> {
        self.checks
            .iter()
            .find(|check| check.name == name)
            .map(|check| &check.outcome)
    }

    /// The names of the checks that failed.
    pub fn failures(&self) -> Vec<&'static str> {
        self.checks
            .iter()
            .filter(|check| matches!(check.outcome, Outcome::Failed(_)))
            .map(|check| check.name)
            .collect()
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.driver)?;
        for Check { name, outcome } in &self.checks {
            match outcome {
                Outcome::Passed => writeln!(f, "  holds    {name}")?,
                Outcome::Failed(why) => writeln!(f, "  broken   {name}: {why}")?,
                Outcome::Skipped(why) => writeln!(f, "  skipped  {name}: {why}")?,
            }
        }
        Ok(())
    }
}
