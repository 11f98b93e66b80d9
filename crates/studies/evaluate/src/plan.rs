//! Steps of an evaluation before it runs: the output of `--explain`.

use std::fmt;

use taceva_core::Skipped;

/// Steps of an evaluation, and the checks and metrics that it skips.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Plan {
    /// The steps, in order.
    pub steps: Vec<Step>,
    /// Skipped items, with reasons.
    pub skipped: Vec<Skipped>,
}

/// One step.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Step {
    /// Verb of the step: `read`, `decode`, `fit`, `predict`, `score` or `write`.
    pub verb: &'static str,
    /// Object of the verb, with its numbers.
    pub what: String,
}

impl Plan {
    /// Adds a step.
    pub fn step(&mut self, verb: &'static str, what: impl Into<String>) {
        self.steps.push(Step {
            verb,
            what: what.into(),
        });
    }
}

impl fmt::Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for Step { verb, what } in &self.steps {
            writeln!(f, "{verb:<8} {what}")?;
        }
        let width = self
            .skipped
            .iter()
            .map(|skipped| skipped.what.len())
            .max()
            .unwrap_or(0);
        for Skipped { what, reason, .. } in &self.skipped {
            writeln!(f, "{:<8} {what:<width$}  {reason}", "skip")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use taceva_core::SkipReason;

    #[test]
    fn a_plan_reads_as_lines_of_verbs() {
        let mut plan = Plan::default();
        plan.step("read", "400 samples");
        plan.skipped
            .push(Skipped::new("field:frame", SkipReason::NothingReadsIt));
        assert_eq!(
            plan.to_string(),
            "read     400 samples\nskip     field:frame  no requested result reads it\n"
        );
    }
}
