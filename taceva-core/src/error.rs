//! Complete list of the kinds of failure of a device, a plugin or a file.

use std::fmt;

/// Kind of failure of a device, a plugin or a file. Its number is the negated status code of the plugin interface. This type
/// gets no further variant before the next major version of that interface.
///
/// ```
/// use taceva_core::ErrorKind;
/// assert_eq!((ErrorKind::Timeout as i32, ErrorKind::Timeout.to_string()), (4, "timeout".to_owned()));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(i32)]
pub enum ErrorKind {
    /// The named object does not exist.
    NotFound = 1,
    /// The object exists, but this user may not open it.
    PermissionDenied = 2,
    /// Another program or user has the object open.
    Busy = 3,
    /// The call got no answer within its deadline.
    Timeout = 4,
    /// The connection is lost.
    Disconnected = 5,
    /// The operation is not supported.
    Unsupported = 6,
    /// An argument of the caller is invalid.
    InvalidArgument = 7,
    /// The received bytes violate their format.
    Protocol = 8,
    /// A value is outside the allowed range.
    OutOfRange = 9,
    /// The call was stopped on request.
    Interrupted = 10,
    /// The device reports a fault.
    DeviceFault = 11,
    /// The two sides of a binary interface have different layouts.
    Abi = 12,
    /// The source has no further data.
    EndOfStream = 13,
    /// A plugin's code panicked, and the panic was caught.
    Panicked = 14,
    /// A bug in TacEva.
    Internal = 15,
}

impl ErrorKind {
    /// Every kind of failure, in the order of the numbers.
    pub const ALL: [ErrorKind; 15] = [
        ErrorKind::NotFound,
        ErrorKind::PermissionDenied,
        ErrorKind::Busy,
        ErrorKind::Timeout,
        ErrorKind::Disconnected,
        ErrorKind::Unsupported,
        ErrorKind::InvalidArgument,
        ErrorKind::Protocol,
        ErrorKind::OutOfRange,
        ErrorKind::Interrupted,
        ErrorKind::DeviceFault,
        ErrorKind::Abi,
        ErrorKind::EndOfStream,
        ErrorKind::Panicked,
        ErrorKind::Internal,
    ];
}

impl fmt::Display for ErrorKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            ErrorKind::NotFound => "not found",
            ErrorKind::PermissionDenied => "permission denied",
            ErrorKind::Busy => "busy",
            ErrorKind::Timeout => "timeout",
            ErrorKind::Disconnected => "disconnected",
            ErrorKind::Unsupported => "unsupported",
            ErrorKind::InvalidArgument => "invalid argument",
            ErrorKind::Protocol => "malformed data",
            ErrorKind::OutOfRange => "out of range",
            ErrorKind::Interrupted => "interrupted",
            ErrorKind::DeviceFault => "device fault",
            ErrorKind::Abi => "incompatible interface",
            ErrorKind::EndOfStream => "end of stream",
            ErrorKind::Panicked => "panicked",
            ErrorKind::Internal => "internal error",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_numbers_of_the_kinds_count_up_from_one() {
        for (position, kind) in ErrorKind::ALL.into_iter().enumerate() {
            assert_eq!(kind as usize, position + 1);
        }
    }
}
