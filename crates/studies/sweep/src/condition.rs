//! Conditions over tasks: `model = ridge and size = 64x64 or seed != 1`.

mod alternatives;
mod term;

use std::collections::BTreeSet;

use taceva_models::Suggestion;

use crate::error::SweepError;
use crate::task::Task;

use term::Term;

/// Selection of tasks: by key, or by alternatives. A task matches an alternative if all its terms hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Condition {
    text: String,
    alternatives: Vec<Vec<Term>>,
}

impl Condition {
    /// Names that a condition may use besides the settings of tasks.
    pub const NAMES: [&'static str; 6] = ["key", "dataset", "task", "model", "split", "seed"];

    /// Parses terms `NAME = VALUE` or `NAME != VALUE`, joined by ` and ` and ` or `; ` and ` has precedence. A value that contains an
    /// operator must be quoted. A text of 4 to 32 hexadecimal digits is the key of a task or a prefix of it.
    ///
    /// ```
    /// use taceva_sweep::Condition;
    /// assert!(Condition::parse("model = ridge and size != 64x64 or seed = 1").is_ok());
    /// let error = Condition::parse("ridge or pls").unwrap_err();
    /// assert!(error.to_string().contains("`ridge`: expected NAME = VALUE"), "{error}");
    /// ```
    ///
    /// # Errors
    /// [`SweepError::Condition`] with the invalid term.
    pub fn parse(text: &str) -> Result<Condition, SweepError> {
        let trimmed = text.trim();
        let is_digits = trimmed.bytes().all(|byte| byte.is_ascii_hexdigit());
        let alternatives = match (4..=32).contains(&trimmed.len()) && is_digits {
            true => vec![vec![Term::of_key(trimmed)]],
            false => {
                alternatives::alternatives(trimmed).map_err(|problem| SweepError::Condition {
                    text: text.to_owned(),
                    problem,
                })?
            }
        };
        Ok(Condition {
            text: text.to_owned(),
            alternatives,
        })
    }

    /// Text of the condition as the user typed it.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Rejects a name that no task of the sweep uses.
    ///
    /// # Errors
    /// [`SweepError::Condition`] with the most similar known name.
    pub(crate) fn check_names(&self, settings: &BTreeSet<String>) -> Result<(), SweepError> {
        let known = || {
            let settings = settings.iter().map(String::as_str);
            Condition::NAMES.into_iter().chain(settings)
        };
        for term in self.alternatives.iter().flatten() {
            if !known().any(|name| name == term.name) {
                let suggestion = Suggestion::of(&term.name, known());
                return Err(SweepError::Condition {
                    text: self.text.clone(),
                    problem: format!("no task has `{}`: {suggestion}", term.name),
                });
            }
        }
        Ok(())
    }

    /// True if `task` satisfies the condition.
    pub fn holds(&self, task: &Task) -> bool {
        let mut alternatives = self.alternatives.iter();
        alternatives.any(|terms| terms.iter().all(|term| term.holds(task)))
    }
}
