//! Checks of the table `[stress]` of a scene. The program that knows the faults checks their names.

use super::document::WrittenScene;
use super::{Check, Checked};
use crate::scene::stress::StressSpec;

impl Check<'_> {
    pub(super) fn stress(&self, stress: Option<&StressSpec>) -> Checked {
        let Some(stress) = stress else {
            return Ok(());
        };
        if let Some([]) = stress.faults.as_deref() {
            return self.contradiction(
                None,
                "`faults` of [stress] is empty: remove it to test all faults",
            );
        }
        let severities = stress.severities.as_deref();
        if let Some([]) = severities {
            return self.contradiction(
                None,
                "`severities` of [stress] is empty: remove it to test all severities",
            );
        }
        let severities = severities.unwrap_or_default();
        for severity in severities {
            self.count("severities", severity, 1, u64::from(StressSpec::MOST))?;
        }
        let mut pairs = severities.windows(2);
        if let Some([before, after]) = pairs.find(|pair| pair[0].value >= pair[1].value) {
            let problem = format!(
                "severity {} after {}, expected ascending severities such as [1, 3, 5]",
                after.value, before.value
            );
            return self.contradiction(after.at(), &problem);
        }
        match &stress.seeds {
            Some(seeds) => self.count("seeds", seeds, 1, u64::from(StressSpec::DRAWS)),
            None => Ok(()),
        }
    }

    /// Checks the faults of plugins: names must be valid and distinct, and a table `[stress]` must exist to test the faults.
    pub(super) fn plugin_faults(&self, written: &WrittenScene) -> Checked {
        for (number, fault) in written.fault.iter().enumerate() {
            self.name("a fault", &fault.name)?;
            let mut before = written.fault[..number].iter();
            if before.any(|before| before.name == fault.name) {
                let problem = format!(
                    "two faults are called `{}`, expected different names",
                    fault.name.value
                );
                return self.contradiction(fault.name.at(), &problem);
            }
            if written.stress.is_none() {
                return self.contradiction(
                    fault.name.at(),
                    "[[fault]] without [stress], which tests it: add a table [stress]",
                );
            }
        }
        Ok(())
    }
}
