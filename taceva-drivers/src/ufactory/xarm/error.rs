//! Constructors for errors of the driver.

use taceva_core::{DriverError, ErrorKind};

use super::KEY;
use super::exchange::ExchangeError;

/// Creates an error of this driver that occurred while `doing`, with the reason `why`.
pub(super) fn failed(
    kind: ErrorKind,
    doing: &'static str,
    why: impl Into<Box<dyn std::error::Error + Send + Sync>>,
) -> DriverError {
    DriverError::new(kind, &KEY, doing).because(why)
}

/// Returns a function that converts a failed exchange into an error that occurred while `doing`.
pub(super) fn unanswered(doing: &'static str) -> impl Fn(ExchangeError) -> DriverError {
    move |error| failed(error.kind(), doing, error)
}
