//! Why a call across the boundary did not do what it was asked.

use taceva_abi::{FaultNumber, Status};
use taceva_core::{DriverError, ErrorKind, Fault, ModelError};

/// A failure on its way to the host: a status, and a message that needs no context but the call.
#[derive(Debug)]
pub(crate) struct Failure {
    pub(crate) status: Status,
    pub(crate) message: String,
    pub(crate) fault: FaultNumber,
}

impl Failure {
    pub(crate) fn new(kind: ErrorKind, message: impl Into<String>) -> Failure {
        Failure {
            // The numbers of the kinds are those of the statuses, negated: a test of core holds them to it.
            status: Status(-(kind as i32)),
            message: message.into(),
            fault: FaultNumber::NONE,
        }
    }

    /// The caller's fault.
    pub(crate) fn argument(message: impl Into<String>) -> Failure {
        Failure::new(ErrorKind::InvalidArgument, message)
    }

    /// A bug of the device.
    pub(crate) fn device(message: impl Into<String>) -> Failure {
        Failure::new(ErrorKind::DeviceFault, message)
    }
}

impl From<DriverError> for Failure {
    /// What it did and the reason: which driver it was, the host knows, which leaves out what it did where it says the same.
    fn from(error: DriverError) -> Failure {
        let message = match std::error::Error::source(&error) {
            Some(reason) => format!("cannot {}: {reason}", error.doing()),
            // The fault is said beside the message.
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
        // One that is newer than this crate is still a fault.
        _ => FaultNumber::SERVO,
    }
}

impl From<ModelError> for Failure {
    fn from(error: ModelError) -> Failure {
        Failure::new(error.kind(), error.to_string())
    }
}
