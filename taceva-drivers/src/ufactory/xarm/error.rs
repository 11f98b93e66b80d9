//! Errors of the driver.

use taceva_core::{DriverError, ErrorKind};

use super::KEY;
use super::exchange::ExchangeError;

/// Creates an error with a reason.
pub(super) fn failed(
    kind: ErrorKind,
    doing: &'static str,
    why: impl Into<Box<dyn std::error::Error + Send + Sync>>,
) -> DriverError {
    DriverError::new(kind, &KEY, doing).because(why)
}

/// Converts a failed exchange into an error that occurred while `doing`.
pub(super) fn unanswered(doing: &'static str) -> impl Fn(ExchangeError) -> DriverError {
    move |error| failed(error.kind(), doing, error)
}
