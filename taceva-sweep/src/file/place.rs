//! Places in the file of a sweep, where errors are named.

use std::path::Path;

use crate::error::SweepError;

/// The file, where errors are named.
#[derive(Clone, Copy)]
pub(super) struct FilePlace<'a> {
    pub(super) path: &'a Path,
    pub(super) text: &'a str,
}

impl FilePlace<'_> {
    /// What is wrong with what stands below `key`, with its line.
    pub(super) fn wrong(&self, key: &str, problem: String) -> SweepError {
        let line = self.text.lines().position(|line| {
            let code = line.split('#').next().unwrap_or_default();
            code.split(|letter: char| !(letter.is_alphanumeric() || "_-".contains(letter)))
                .any(|word| word == key)
        });
        SweepError::Meaning {
            path: self.path.to_owned(),
            line: line.map(|line| line + 1),
            problem,
        }
    }

    /// Refuses a value that comes twice.
    pub(super) fn check_distinct<T: PartialEq + std::fmt::Display>(
        &self,
        key: &str,
        values: &[T],
    ) -> Result<(), SweepError> {
        for (at, value) in values.iter().enumerate() {
            if values[..at].contains(value) {
                return Err(self.wrong(key, format!("`{key}`: {value} comes twice")));
            }
        }
        Ok(())
    }
}
