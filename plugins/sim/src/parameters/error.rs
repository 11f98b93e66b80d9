//! Errors of a parameter table.

use thiserror::Error;

/// Error of a rejected parameter table, with the line of the fault.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("line {line}: {kind}")]
pub struct ParameterError {
    line: usize,
    kind: ParameterErrorKind,
}

/// Kinds of errors.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ParameterErrorKind {
    /// The text is not TOML.
    #[error("{message}")]
    Syntax {
        /// Message of the parser.
        message: String,
    },
    /// An unknown section or key.
    #[error("`{key}`: unknown {what}{}", nearest.as_ref().map(|near| format!(", did you mean `{near}`?")).unwrap_or_default())]
    Unknown {
        /// Kind of word: a section, a key, or a part of a value.
        what: &'static str,
        /// Word in the table.
        key: String,
        /// Nearest known word; `None` if none is near.
        nearest: Option<String>,
    },
    /// A required section or key is missing.
    #[error("`{key}`: missing, expected {expected}")]
    Missing {
        /// Name of the section or key.
        key: String,
        /// Expected value.
        expected: String,
    },
    /// A value has another type, unit or origin than expected.
    #[error("`{key}`: found {found}, expected {expected}")]
    Form {
        /// Name of the key.
        key: String,
        /// Value found.
        found: String,
        /// Expected value.
        expected: String,
    },
    /// A value is out of range.
    #[error("`{key}`: found {value}, expected {expected}")]
    Range {
        /// Name of the key.
        key: String,
        /// Value found.
        value: f64,
        /// Accepted range.
        expected: String,
    },
}

impl ParameterError {
    pub(super) fn new(line: usize, kind: ParameterErrorKind) -> ParameterError {
        ParameterError { line, kind }
    }

    /// Line of the fault in the table, counted from 1; the last line for missing parts.
    pub fn line(&self) -> usize {
        self.line
    }

    /// Kind of the error.
    pub fn kind(&self) -> &ParameterErrorKind {
        &self.kind
    }
}
