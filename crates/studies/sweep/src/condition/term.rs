//! One term of a condition: `size != 64x64`.

use crate::task::Task;

/// Accepted forms of a term, for messages.
const UNDERSTOOD: &str = "expected NAME = VALUE or NAME != VALUE, joined by ` and ` or ` or ` (no parentheses), or the key of a task";
/// Characters not allowed in an unquoted value. A term with such a value is rejected.
const SIGNS: [char; 9] = ['=', '!', '<', '>', '&', '|', '(', ')', '"'];

/// Condition that a property of a task, or the beginning of its key, equals a value or differs from it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Term {
    pub(super) name: String,
    pub(super) is_equal: bool,
    pub(super) value: String,
}

impl Term {
    /// Selects tasks whose key begins with `digits`.
    pub(super) fn of_key(digits: &str) -> Term {
        Term {
            name: "key".to_owned(),
            is_equal: true,
            value: digits.to_owned(),
        }
    }

    pub(super) fn parse(text: &str) -> Result<Term, String> {
        let wrong = || format!("`{}`: {UNDERSTOOD}", taceva_core::shown(text.trim()));
        let (name, rest) = text.split_once('=').ok_or_else(wrong)?;
        let (name, is_equal) = match name.strip_suffix('!') {
            Some(name) => (name.trim(), false),
            None => (name.trim(), true),
        };
        let is_word = |letter: char| letter.is_alphanumeric() || "_-.".contains(letter);
        let value = value(rest.trim()).ok_or_else(wrong)?;
        match !name.is_empty() && name.chars().all(is_word) && !value.is_empty() {
            true => Ok(Term {
                name: name.to_owned(),
                is_equal,
                value: value.to_owned(),
            }),
            false => Err(wrong()),
        }
    }

    /// True if `task` satisfies the term.
    pub(super) fn holds(&self, task: &Task) -> bool {
        let is_same = match self.name.as_str() {
            "key" => task.key.as_str().starts_with(&self.value),
            name => task.word(name).as_deref() == Some(self.value.as_str()),
        };
        is_same == self.is_equal
    }
}

/// Parses a value, bare or quoted; `None` if it is neither.
fn value(text: &str) -> Option<&str> {
    for quote in ['"', '\''] {
        if let Some(inside) = text.strip_prefix(quote) {
            let inside = inside.strip_suffix(quote)?;
            return (!inside.contains(quote)).then_some(inside);
        }
    }
    let mut words = text.split(' ');
    let is_joint = |word: &str| matches!(word, "and" | "or");
    let is_bare = !text.contains(SIGNS) && !text.contains('\'') && !words.any(is_joint);
    is_bare.then_some(text)
}
