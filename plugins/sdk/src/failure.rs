//! Failures that the plugin reports to the host.

use taceva_abi::{FaultNumber, MESSAGE_SIZE, Status};
use taceva_core::{DriverError, ErrorKind, Fault, ModelError};

/// Failure for the host: a status and a message. The host adds the name of the call to the message.
#[derive(Debug)]
pub(crate) struct Failure {
    pub(crate) status: Status,
    pub(crate) message: String,
    pub(crate) fault: FaultNumber,
}

impl Failure {
    pub(crate) fn new(kind: ErrorKind, message: impl Into<String>) -> Failure {
        Failure {
            // The numbers of the kinds are the negated statuses. A test of core verifies this.
            status: Status(-(kind as i32)),
            message: message.into(),
            fault: FaultNumber::NONE,
        }
    }

    /// Creates the failure for a wrong argument of the host.
    pub(crate) fn argument(message: impl Into<String>) -> Failure {
        Failure::new(ErrorKind::InvalidArgument, message)
    }

    /// Creates the failure for a fault of the device.
    pub(crate) fn device(message: impl Into<String>) -> Failure {
        Failure::new(ErrorKind::DeviceFault, message)
    }
}

impl From<DriverError> for Failure {
    /// Creates a message of the operation and the reason, or only of the reason if both exceed the length of a message. The host adds the driver and
    /// the call.
    fn from(error: DriverError) -> Failure {
        let message = match std::error::Error::source(&error) {
            Some(reason) => {
                let both = format!("cannot {}: {reason}", error.doing());
                match both.len() < MESSAGE_SIZE {
                    true => both,
                    false => reason.to_string(),
                }
            }
            // The fault is a separate field of the error, so it needs no message.
            None if error.fault().is_some() => String::new(),
            None => error.kind().to_string(),
        };
        Failure {
            fault: error.fault().map_or(FaultNumber::NONE, number),
            ..Failure::new(error.kind(), message)
        }
    }
}

fn number(fault: Fault) -> FaultNumber {
    match fault {
        Fault::EmergencyStop => FaultNumber::EMERGENCY_STOP,
        Fault::Collision => FaultNumber::COLLISION,
        Fault::Boundary => FaultNumber::BOUNDARY,
        // A fault that this crate does not know is still reported as a fault.
        _ => FaultNumber::SERVO,
    }
}

impl From<ModelError> for Failure {
    fn from(error: ModelError) -> Failure {
        Failure::new(error.kind(), error.to_string())
    }
}

#[cfg(test)]
mod tests {
    use taceva_core::DriverKey;

    use super::*;

    #[test]
    fn what_was_done_is_left_out_where_the_reason_alone_fills_a_message() {
        const KEY: DriverKey = DriverKey::fixed("lab/scale");
        let said = |reason: &str| {
            let error = DriverError::new(ErrorKind::Timeout, &KEY, "read the force");
            Failure::from(error.because(reason)).message
        };
        assert_eq!(said("silence"), "cannot read the force: silence");
        let long = "x".repeat(MESSAGE_SIZE - 1);
        assert_eq!(said(&long), long);
    }
}
