//! Locations in a sweep file for error messages.

use std::path::Path;

use crate::error::SweepError;

/// Sweep file and its text, for error messages.
#[derive(Clone, Copy)]
pub(super) struct FilePlace<'a> {
    pub(super) path: &'a Path,
    pub(super) text: &'a str,
}

impl FilePlace<'_> {
    /// Error for an invalid value of `key`, with its line.
    pub(super) fn wrong(&self, key: &str, problem: String) -> SweepError {
        SweepError::Meaning {
            path: self.path.to_owned(),
            line: self.line_of(key),
            problem,
        }
    }

    /// Line that assigns `key`, or else the first line that contains `key` as a word, such as a model in a list.
    pub(super) fn line_of(&self, key: &str) -> Option<usize> {
        let mut lines = self.text.lines();
        let set = lines.position(|line| {
            let rest = line.trim_start().strip_prefix(key);
            rest.is_some_and(|rest| rest.trim_start().starts_with('='))
        });
        let line = set.or_else(|| self.text.lines().position(|line| has_word(line, key)));
        line.map(|line| line + 1)
    }

    /// Rejects a value that occurs twice.
    pub(super) fn check_distinct<T: PartialEq + std::fmt::Display>(
        &self,
        key: &str,
        values: &[T],
    ) -> Result<(), SweepError> {
        for (at, value) in values.iter().enumerate() {
            if values[..at].contains(value) {
                return Err(self.wrong(key, format!("`{key}`: {value} is listed twice")));
            }
        }
        Ok(())
    }
}

/// True if `key` is a word of `line` outside its comment.
fn has_word(line: &str, key: &str) -> bool {
    let code = line.split('#').next().unwrap_or_default();
    let mut words = code.split(|letter: char| !(letter.is_alphanumeric() || "_-".contains(letter)));
    words.any(|word| word == key)
}
