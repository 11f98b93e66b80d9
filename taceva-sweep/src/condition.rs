//! Conditions over tasks: `model = ridge and size = 64x64`.

use std::collections::BTreeSet;

use taceva_models::Suggestion;

use crate::error::SweepError;
use crate::task::Task;

/// Which tasks are meant: those of one key, or those of which every term holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Condition {
    text: String,
    terms: Vec<Term>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
struct Term {
    name: String,
    is_equal: bool,
    value: String,
}

impl Condition {
    /// What can be asked beside the settings of tasks.
    pub const NAMES: [&'static str; 5] = ["key", "dataset", "model", "split", "seed"];

    /// The condition that `text` states: terms `NAME = VALUE` or `NAME != VALUE` with ` and ` between them, or the key of a task or how it
    /// begins.
    ///
    /// ```
    /// use taceva_sweep::Condition;
    /// assert!(Condition::parse("model = ridge and size != 64x64").is_ok());
    /// let error = Condition::parse("ridge or pls").unwrap_err();
    /// assert!(error.to_string().contains("expected NAME = VALUE"), "{error}");
    /// ```
    ///
    /// # Errors
    /// [`SweepError::Condition`].
    pub fn parse(text: &str) -> Result<Condition, SweepError> {
        let trimmed = text.trim();
        let is_digits = trimmed.bytes().all(|byte| byte.is_ascii_hexdigit());
        if (4..=32).contains(&trimmed.len()) && is_digits {
            let term = Term {
                name: "key".to_owned(),
                is_equal: true,
                value: trimmed.to_owned(),
            };
            return Ok(Condition {
                text: text.to_owned(),
                terms: vec![term],
            });
        }
        let terms = trimmed.split(" and ").map(|term| Term::parse(text, term));
        Ok(Condition {
            text: text.to_owned(),
            terms: terms.collect::<Result<_, _>>()?,
        })
    }

    /// As typed.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Refuses a name that no task of the sweep has.
    ///
    /// # Errors
    /// [`SweepError::Condition`] with the nearest name.
    pub(crate) fn check_names(&self, settings: &BTreeSet<String>) -> Result<(), SweepError> {
        let known = || {
            let settings = settings.iter().map(String::as_str);
            Condition::NAMES.into_iter().chain(settings)
        };
        for term in &self.terms {
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

    /// Whether it holds of `task`.
    pub fn holds(&self, task: &Task) -> bool {
        self.terms.iter().all(|term| {
            let is_same = match term.name.as_str() {
                "key" => task.key.as_str().starts_with(&term.value),
                name => task.word(name).as_deref() == Some(term.value.as_str()),
            };
            is_same == term.is_equal
        })
    }
}

impl Term {
    fn parse(whole: &str, text: &str) -> Result<Term, SweepError> {
        let parts = match text.split_once("!=") {
            Some((name, value)) => Some((name, false, value)),
            None => text
                .split_once('=')
                .map(|(name, value)| (name, true, value)),
        };
        let unquoted = |text: &str| text.trim().trim_matches(['"', '\'']).to_owned();
        let term = parts.map(|(name, is_equal, value)| Term {
            name: name.trim().to_owned(),
            is_equal,
            value: unquoted(value),
        });
        term.filter(|term| {
            let is_word = |letter: char| letter.is_alphanumeric() || "_-.".contains(letter);
            !term.name.is_empty() && term.name.chars().all(is_word) && !term.value.is_empty()
        })
        .ok_or_else(|| SweepError::Condition {
            text: whole.to_owned(),
            problem: "expected NAME = VALUE or NAME != VALUE, several with ` and ` between them, or the key of a task".to_owned(),
        })
    }
}
