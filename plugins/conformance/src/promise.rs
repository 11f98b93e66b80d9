//! Reasons why a promise is broken or skipped, and functions that create them.

use std::fmt;

use taceva_core::{DriverError, ErrorKind, ModelError, Stamp};

/// Reason why a promise did not pass.
#[derive(Debug)]
pub(crate) enum Unmet {
    /// The driver broke the promise.
    Broken(String),
    /// The promise could not be tested, or does not apply to this driver.
    Skipped(String),
}

impl From<DriverError> for Unmet {
    fn from(error: DriverError) -> Unmet {
        Unmet::Broken(format!("{error} ({})", error.kind()))
    }
}

impl From<ModelError> for Unmet {
    fn from(error: ModelError) -> Unmet {
        Unmet::Broken(error.to_string())
    }
}

/// Creates the reason of a broken promise.
pub(crate) fn broken(why: impl Into<String>) -> Unmet {
    Unmet::Broken(why.into())
}

/// Creates the reason of a promise that was not tested.
pub(crate) fn skipped(why: impl Into<String>) -> Unmet {
    Unmet::Skipped(why.into())
}

/// Fails with the reason `why` unless `holds` is true.
pub(crate) fn expect(holds: bool, why: impl FnOnce() -> String) -> Result<(), Unmet> {
    if holds { Ok(()) } else { Err(broken(why())) }
}

/// Error that has an [`ErrorKind`].
pub(crate) trait Kinded: fmt::Display {
    /// Kind of the error.
    fn of_kind(&self) -> ErrorKind;
}

impl Kinded for DriverError {
    fn of_kind(&self) -> ErrorKind {
        self.kind()
    }
}

impl Kinded for ModelError {
    fn of_kind(&self) -> ErrorKind {
        self.kind()
    }
}

/// Fails unless `result` is an error whose kind is in `kinds`.
pub(crate) fn refused<T, E: Kinded>(
    doing: &str,
    result: Result<T, E>,
    kinds: &[ErrorKind],
) -> Result<(), Unmet> {
    let found = match result {
        Err(error) if kinds.contains(&error.of_kind()) => return Ok(()),
        Err(error) => format!("gave `{}` ({error})", error.of_kind()),
        Ok(_) => "succeeded".to_owned(),
    };
    let expected: Vec<String> = kinds.iter().map(|kind| format!("`{kind}`")).collect();
    let expected = expected.join(" or ");
    Err(broken(format!("{doing} {found}, expected {expected}")))
}

/// Fails unless `result` is `Ok` or an error of the kind `otherwise`.
pub(crate) fn answered<T>(
    doing: &str,
    result: Result<T, DriverError>,
    otherwise: ErrorKind,
) -> Result<(), Unmet> {
    match result {
        Ok(_) => Ok(()),
        error => refused(doing, error, &[otherwise]),
    }
}

/// Fails unless the times of `stamps` are finite, the times of validity increase, and no item was received before it was valid.
pub(crate) fn in_order(stamps: &[Stamp]) -> Result<(), Unmet> {
    for stamp in stamps {
        let valid_s = stamp.valid_s;
        // An unknown time of receipt is no contradiction.
        let received_s = stamp.received_s.unwrap_or(valid_s);
        expect(valid_s.is_finite() && received_s.is_finite(), || {
            format!("valid at {valid_s} s, received at {received_s} s, expected finite times")
        })?;
        expect(received_s >= valid_s, || {
            format!("received at {received_s} s, before it was valid at {valid_s} s")
        })?;
    }
    for pair in stamps.windows(2) {
        let (before, after) = (pair[0].valid_s, pair[1].valid_s);
        expect(before < after, || {
            format!(
                "a stamp of {after} s follows a stamp of {before} s, expected increasing stamps"
            )
        })?;
    }
    Ok(())
}
