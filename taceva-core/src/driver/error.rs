//! Errors of calls to devices.

use std::borrow::Cow;
use std::error::Error;
use std::fmt;

use super::Fault;
use crate::error::ErrorKind;
use crate::id::DriverKey;

/// A failed call to a device: kind of failure, driver, operation and cause.
///
/// ```
/// use taceva_core::{DriverError, DriverKey, ErrorKind};
/// let camera = DriverKey::fixed("org.example/camera");
/// let error = DriverError::new(ErrorKind::Timeout, &camera, "capture a frame").because("no frame within 40 ms");
/// assert_eq!(error.kind(), ErrorKind::Timeout);
/// assert_eq!(error.to_string(), "org.example/camera: cannot capture a frame: no frame within 40 ms");
/// ```
#[derive(Debug)]
pub struct DriverError {
    kind: ErrorKind,
    driver: DriverKey,
    doing: Cow<'static, str>,
    fault: Option<Fault>,
    source: Option<Box<dyn Error + Send + Sync>>,
}

impl DriverError {
    /// Error of `driver` during an operation. `doing` names the operation in the message "cannot `doing`", such as `capture a frame`.
    pub fn new(
        kind: ErrorKind,
        driver: &DriverKey,
        doing: impl Into<Cow<'static, str>>,
    ) -> DriverError {
        DriverError {
            kind,
            driver: driver.clone(),
            doing: doing.into(),
            fault: None,
            source: None,
        }
    }

    /// The same error with the `fault` of the device.
    #[must_use]
    pub fn with_fault(mut self, fault: Fault) -> DriverError {
        self.fault = Some(fault);
        self
    }

    /// The same error with its cause: another error, or a sentence that names the value found and the values accepted.
    #[must_use]
    pub fn because(mut self, source: impl Into<Box<dyn Error + Send + Sync>>) -> DriverError {
        self.source = Some(source.into());
        self
    }

    /// Kind of failure.
    pub fn kind(&self) -> ErrorKind {
        self.kind
    }

    /// Fault for which the device stopped by itself; `None` if the device reported none.
    pub fn fault(&self) -> Option<Fault> {
        self.fault
    }

    /// The driver that failed.
    pub fn driver(&self) -> &DriverKey {
        &self.driver
    }

    /// Failed operation, such as `capture a frame`.
    pub fn doing(&self) -> &str {
        &self.doing
    }
}

impl fmt::Display for DriverError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: cannot {}: ", self.driver, self.doing)?;
        match (&self.source, self.fault) {
            (Some(source), Some(fault)) => write!(f, "{fault}: {source}"),
            (Some(source), None) => write!(f, "{source}"),
            (None, Some(fault)) => write!(f, "{fault}"),
            (None, None) => write!(f, "{}", self.kind),
        }
    }
}

impl Error for DriverError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        self.source
            .as_deref()
            .map(|source| source as &(dyn Error + 'static))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CAMERA: DriverKey = DriverKey::fixed("test/camera");

    #[test]
    fn the_message_names_the_driver_what_it_did_and_why_it_could_not() {
        let bare = DriverError::new(ErrorKind::Timeout, &CAMERA, "capture a frame");
        assert_eq!(
            bare.to_string(),
            "test/camera: cannot capture a frame: timeout"
        );
        let caused = bare.because("no frame within 40ms");
        assert_eq!(
            caused.to_string(),
            "test/camera: cannot capture a frame: no frame within 40ms"
        );
        assert_eq!((caused.kind(), caused.fault()), (ErrorKind::Timeout, None));
        assert!(caused.source().is_some());
    }

    #[test]
    fn a_fault_is_kept_and_stands_in_the_message_before_its_cause() {
        for fault in Fault::ALL {
            let arm = DriverKey::fixed("test/arm");
            let bare = DriverError::new(ErrorKind::DeviceFault, &arm, "move").with_fault(fault);
            assert_eq!(bare.fault(), Some(fault));
            assert_eq!(bare.to_string(), format!("test/arm: cannot move: {fault}"));
            let caused = bare.because("code 2").to_string();
            assert_eq!(caused, format!("test/arm: cannot move: {fault}: code 2"));
        }
    }
}
