//! Errors of fitting, saving, loading and applying a model.

use std::error::Error;
use std::fmt;

use crate::error::ErrorKind;

/// Error of fitting, saving, loading or applying a model.
///
/// ```
/// use taceva_core::{ErrorKind, ModelError};
/// let error = ModelError::new(ErrorKind::InvalidArgument, "cannot fit `ridge`: 1 sample, expected at least 2");
/// assert_eq!(error.kind(), ErrorKind::InvalidArgument);
/// ```
#[derive(Debug)]
pub struct ModelError {
    kind: ErrorKind,
    message: String,
    source: Option<Box<dyn Error + Send + Sync>>,
}

impl ModelError {
    /// Error of `kind` with a message that names the operation and its subject.
    pub fn new(kind: ErrorKind, message: impl Into<String>) -> ModelError {
        ModelError {
            kind,
            message: message.into(),
            source: None,
        }
    }

    /// Adds the error `source` as the cause.
    #[must_use]
    pub fn because(mut self, source: impl Into<Box<dyn Error + Send + Sync>>) -> ModelError {
        self.source = Some(source.into());
        self
    }

    /// Category of the error.
    pub fn kind(&self) -> ErrorKind {
        self.kind
    }
}

impl fmt::Display for ModelError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl Error for ModelError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        self.source
            .as_deref()
            .map(|source| source as &(dyn Error + 'static))
    }
}
