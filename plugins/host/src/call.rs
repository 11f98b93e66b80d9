//! Calls functions of a plugin library. Converts statuses to errors, keeps messages, checks and copies texts and tables.

mod arguments;
pub mod pending_call;
mod table;
mod text_list;

pub use self::arguments::ArgList;
pub use self::table::Table;
pub(crate) use self::table::table;
pub use self::text_list::{Taken, take};

use std::fmt;

use taceva_abi as abi;
use taceva_core::{Deadline, DriverError, DriverKey, ErrorKind, Fault, shown};

/// Failed call, with the message of the plugin or of the host.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    kind: ErrorKind,
    message: String,
    fault: Option<Fault>,
}

impl Failure {
    /// Creates a failure that the host detected.
    pub(crate) fn new(kind: ErrorKind, message: impl Into<String>) -> Failure {
        Failure {
            kind,
            message: message.into(),
            fault: None,
        }
    }

    /// Kind of the failure.
    pub fn kind(&self) -> ErrorKind {
        self.kind
    }

    /// Converts the failure into an error of `driver` that names the failed operation `doing`.
    pub(crate) fn of(self, driver: &DriverKey, doing: &'static str) -> DriverError {
        let error = DriverError::new(self.kind, driver, doing);
        // The message may already begin with "cannot `doing`: ", which the error adds itself.
        let same = format!("cannot {doing}: ");
        let message = match self.message.strip_prefix(&same) {
            Some(reason) => reason.to_owned(),
            None => self.message,
        };
        match self.fault {
            None => error.because(message),
            // The error's message already contains the fault.
            Some(fault) if message.is_empty() => error.with_fault(fault),
            Some(fault) => error.with_fault(fault).because(message),
        }
    }

    /// Message of the plugin or of the host.
    pub fn message(self) -> String {
        self.message
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Failure {}

/// Calls `run` with an empty error, and converts the returned status into a result.
pub fn call(run: impl FnOnce(&mut abi::Error) -> abi::Status) -> Result<(), Failure> {
    let mut error = abi::Error::new();
    let status = run(&mut error);
    if status.is_ok() {
        return Ok(());
    }
    let position = usize::try_from(-i64::from(status.0)).unwrap_or(0);
    let known = position
        .checked_sub(1)
        .and_then(|at| ErrorKind::ALL.get(at));
    let Some(&kind) = known else {
        let message = format!("unknown status {}", status.0);
        return Err(Failure::new(ErrorKind::Abi, message));
    };
    let bytes: Vec<u8> = error.bytes().collect();
    let fault = fault(error.fault);
    let mut message = match bytes.as_slice() {
        [] if fault.is_some() => String::new(),
        [] => kind.to_string(),
        // The interface limits the length of the message.
        bytes => shown(&*String::from_utf8_lossy(bytes)).to_string(),
    };
    if error.vendor_code != 0 {
        message.push_str(&format!(" (code {} of the device)", error.vendor_code));
    }
    Err(Failure {
        kind,
        message: message.trim_start().to_owned(),
        fault,
    })
}

/// Converts a fault number. An unknown fault number becomes [`Fault::Servo`], because every fault ends the motion.
fn fault(number: abi::FaultNumber) -> Option<Fault> {
    match number {
        number if !number.is_fault() => None,
        abi::FaultNumber::EMERGENCY_STOP => Some(Fault::EmergencyStop),
        abi::FaultNumber::COLLISION => Some(Fault::Collision),
        abi::FaultNumber::BOUNDARY => Some(Fault::Boundary),
        _ => Some(Fault::Servo),
    }
}

/// Time left until `deadline`, ns.
pub fn timeout(deadline: Deadline) -> u64 {
    u64::try_from(deadline.remaining().as_nanos()).unwrap_or(u64::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_status_is_the_kind_of_its_number_and_no_other_number_is_one() {
        for kind in ErrorKind::ALL {
            let number = i32::try_from(kind as u32).expect("small");
            let failure = call(|_| abi::Status(-number)).expect_err("failed");
            assert_eq!(
                (failure.kind(), failure.to_string()),
                (kind, kind.to_string())
            );
        }
        for status in [1, 16, -16, i32::MIN, i32::MAX] {
            let failure = call(|_| abi::Status(status)).expect_err("failed");
            assert_eq!(failure.kind(), ErrorKind::Abi, "{status}");
        }
    }

    #[test]
    fn a_message_is_made_harmless_and_carries_the_devices_own_number() {
        let failure = call(|error| {
            error.write("no\u{1b}[2J answer");
            error.vendor_code = 31;
            abi::Status::TIMEOUT
        });
        let message = failure.expect_err("failed").to_string();
        assert_eq!(message, "no\\u{1b}[2J answer (code 31 of the device)");
        let all = call(|error| {
            error.message.fill(-1);
            abi::Status::TIMEOUT
        });
        assert!(all.expect_err("failed").to_string().starts_with('\u{fffd}'));
    }

    #[test]
    fn a_fault_is_kept_and_one_that_nobody_knows_is_one_too() {
        let arm = DriverKey::fixed("org.example.arm/arm");
        for (number, expected) in [
            (0, None),
            // The end of a truncated message.
            (u32::from_le_bytes(*b"end\0"), None),
            (
                abi::FaultNumber::EMERGENCY_STOP.0,
                Some(Fault::EmergencyStop),
            ),
            (abi::FaultNumber::COLLISION.0, Some(Fault::Collision)),
            (abi::FaultNumber::BOUNDARY.0, Some(Fault::Boundary)),
            (abi::FaultNumber::SERVO.0, Some(Fault::Servo)),
            (abi::FaultNumber::SERVO.0 + 1, Some(Fault::Servo)),
        ] {
            let failure = call(|error| {
                error.fault = abi::FaultNumber(number);
                abi::Status::DEVICE_FAULT
            });
            let error = failure.expect_err("failed").of(&arm, "move");
            assert_eq!(error.fault(), expected, "{number}");
            let words = expected.map_or(ErrorKind::DeviceFault.to_string(), |fault| {
                fault.to_string()
            });
            assert_eq!(
                error.to_string(),
                format!("org.example.arm/arm: cannot move: {words}")
            );
        }
    }
}
