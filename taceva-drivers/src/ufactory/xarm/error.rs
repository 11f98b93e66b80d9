//! Errors of the arm with their reasons.

use taceva_core::{DriverError, ErrorKind};

use super::KEY;
use super::exchange::ExchangeError;

/// An error of the arm with its reason.
pub(super) fn failed(
    kind: ErrorKind,
    doing: &'static str,
    why: impl Into<Box<dyn std::error::Error + Send + Sync>>,
) -> DriverError {
    DriverError::new(kind, &KEY, doing).because(why)
}

/// What an exchange that failed was for.
pub(super) fn unanswered(doing: &'static str) -> impl Fn(ExchangeError) -> DriverError {
    move |error| failed(error.kind(), doing, error)
}
