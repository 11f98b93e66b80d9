//! Meaning of the controller's error codes, and their kinds of fault.

use std::fmt;

use taceva_core::{DriverError, ErrorKind, Fault};

use super::error::failed;

/// Error of the controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct XarmFault {
    /// Error code, as listed in the vendor's documents.
    pub(super) code: u8,
}

impl XarmFault {
    /// Kind of fault for an emergency stop, a servo fault, a collision or the safety boundary; `None` for other errors.
    fn kind(self) -> Option<Fault> {
        match self.code {
            1..=3 => Some(Fault::EmergencyStop),
            10..=17 => Some(Fault::Servo),
            22 | 31 => Some(Fault::Collision),
            35 => Some(Fault::Boundary),
            _ => None,
        }
    }

    /// Converts the error into a driver error that occurred while `doing`.
    pub(super) fn met(self, doing: &'static str) -> DriverError {
        let error = failed(ErrorKind::DeviceFault, doing, self);
        match self.kind() {
            Some(kind) => error.with_fault(kind),
            None => error,
        }
    }

    /// Meaning of the error code, for messages.
    fn meaning(self) -> &'static str {
        match self.code {
            1..=3 => "the emergency stop was pressed",
            10..=17 => "a servo reports a fault",
            18 | 50..=53 => "the force transducer of the arm reports a fault",
            19 | 28 => "the tool does not answer",
            21 | 40 => "the pose cannot be reached",
            22 => "the arm would collide with itself",
            23 | 38 => "a joint is at its limit",
            24 | 30 | 60 => "a speed exceeds its limit",
            25 => "the path cannot be planned",
            31 => "a collision was detected",
            35 => "the safety boundary was left",
            110 | 111 => "the controller does not reach the arm",
            _ => "see the vendor's list of errors",
        }
    }
}

impl fmt::Display for XarmFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "the controller reports error {}: {}; inspect the arm, then clear the error by hand in UFACTORY Studio",
            self.code,
            self.meaning()
        )
    }
}

impl std::error::Error for XarmFault {}
