//! Calls of functions of a library: statuses become errors, messages are kept, texts and tables are checked and copied.

mod arguments;
mod table;
mod taken;

pub(crate) use self::arguments::ArgList;
pub(crate) use self::table::{Table, table};
pub(crate) use self::taken::{Taken, take};

use std::fmt;

use taceva_abi as abi;
use taceva_core::{Deadline, DriverError, DriverKey, ErrorKind};

use crate::shown::shown;

/// A call that failed, in the plugin's words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    kind: ErrorKind,
    message: String,
}

impl Failure {
    /// A failure that the host noticed.
    pub(crate) fn new(kind: ErrorKind, message: impl Into<String>) -> Failure {
        Failure {
            kind,
            message: message.into(),
        }
    }

    /// What kind of failure it was.
    pub fn kind(&self) -> ErrorKind {
        self.kind
    }

    /// The same, as the failure of `driver` while it was `doing`.
    pub(crate) fn of(self, driver: &DriverKey, doing: &'static str) -> DriverError {
        DriverError::new(self.kind, driver, doing).because(self.message)
    }

    pub(crate) fn message(self) -> String {
        self.message
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Failure {}

/// Makes a call with an empty error and reads how it ended.
pub(crate) fn call(run: impl FnOnce(&mut abi::Error) -> abi::Status) -> Result<(), Failure> {
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
        let message = format!("status {}, which is none of the interface's", status.0);
        return Err(Failure::new(ErrorKind::Abi, message));
    };
    let bytes: Vec<u8> = error.bytes().collect();
    let mut message = match bytes.as_slice() {
        [] => kind.to_string(),
        bytes => shown(&String::from_utf8_lossy(bytes)),
    };
    if error.vendor_code != 0 {
        message.push_str(&format!(" (code {} of the device)", error.vendor_code));
    }
    Err(Failure { kind, message })
}

/// The deadline in the interface's unit.
pub(crate) fn timeout(deadline: Deadline) -> u64 {
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
}
