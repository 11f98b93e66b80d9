//! Status of a call.

/// `taceva_status`: 0, or a negative number from the closed list of failures.
///
/// A number rather than an enum, because a plugin may return any number. The host treats an unlisted number as an error of the interface.
///
/// ```
/// use taceva_abi::Status;
/// assert!(Status::OK.is_ok());
/// assert_eq!(Status::TIMEOUT, Status(-4));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(transparent)]
pub struct Status(pub i32);

impl Status {
    /// The call succeeded.
    pub const OK: Status = Status(0);
    /// The device, file or key does not exist.
    pub const NOT_FOUND: Status = Status(-1);
    /// This user lacks the permission.
    pub const PERMISSION_DENIED: Status = Status(-2);
    /// Another program uses the device.
    pub const BUSY: Status = Status(-3);
    /// The timeout expired; the device stays usable.
    pub const TIMEOUT: Status = Status(-4);
    /// The device is no longer connected.
    pub const DISCONNECTED: Status = Status(-5);
    /// The operation is not supported.
    pub const UNSUPPORTED: Status = Status(-6);
    /// An argument of the caller is wrong.
    pub const INVALID_ARGUMENT: Status = Status(-7);
    /// The device sent malformed data.
    pub const PROTOCOL: Status = Status(-8);
    /// A value exceeds a limit of the device.
    pub const OUT_OF_RANGE: Status = Status(-9);
    /// `interrupt` or `halt` ended the call.
    pub const INTERRUPTED: Status = Status(-10);
    /// The device reports a fault, or a number that is not finite.
    pub const DEVICE_FAULT: Status = Status(-11);
    /// The interfaces of the two sides do not match.
    pub const ABI: Status = Status(-12);
    /// No more data will come.
    pub const END_OF_STREAM: Status = Status(-13);
    /// The plugin caught its own panic or exception. The handle is unusable.
    pub const PANICKED: Status = Status(-14);
    /// Host or plugin detected a bug.
    pub const INTERNAL: Status = Status(-15);

    /// True if the call succeeded.
    pub const fn is_ok(self) -> bool {
        self.0 == 0
    }
}
