//! What can be wrong with a parameter table.

use thiserror::Error;

/// A parameter table that was refused, and the line that is to blame.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("line {line}: {kind}")]
pub struct ParameterError {
    line: usize,
    kind: ParameterErrorKind,
}

/// What is wrong.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ParameterErrorKind {
    /// The text is not TOML.
    #[error("{message}")]
    Syntax {
        /// What the parser says.
        message: String,
    },
    /// A section or key that nobody reads.
    #[error("`{key}`: unknown {what}{}", nearest.as_ref().map(|near| format!(", did you mean `{near}`?")).unwrap_or_default())]
    Unknown {
        /// What it is: a section, a key, a part of a number.
        what: &'static str,
        /// How it is written.
        key: String,
        /// The known word nearest to it.
        nearest: Option<String>,
    },
    /// A section or key that is needed.
    #[error("`{key}`: missing, expected {expected}")]
    Missing {
        /// Its name.
        key: String,
        /// What would be accepted.
        expected: String,
    },
    /// A value of another type, unit or origin than expected.
    #[error("`{key}`: found {found}, expected {expected}")]
    Form {
        /// Its name.
        key: String,
        /// What stands there.
        found: String,
        /// What would be accepted.
        expected: String,
    },
    /// A number outside its range.
    #[error("`{key}`: found {value}, expected {expected}")]
    Range {
        /// Its name.
        key: String,
        /// The number.
        value: f64,
        /// What would be accepted.
        expected: String,
    },
}

impl ParameterError {
    pub(super) fn new(line: usize, kind: ParameterErrorKind) -> ParameterError {
        ParameterError { line, kind }
    }

    /// The line of the table, from 1; the last one for what is missing.
    pub fn line(&self) -> usize {
        self.line
    }

    /// What is wrong there.
    pub fn kind(&self) -> &ParameterErrorKind {
        &self.kind
    }
}
