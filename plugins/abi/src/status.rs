//! How a call ended.

/// `taceva_status`: 0, or one of the closed list of failures, negative.
///
/// A number rather than an enum: a plugin may return any, and one that is not listed is an error of the interface.
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
    /// It did what it was asked.
    pub const OK: Status = Status(0);
    /// The device, file or key is not there.
    pub const NOT_FOUND: Status = Status(-1);
    /// This user may not.
    pub const PERMISSION_DENIED: Status = Status(-2);
    /// Somebody else holds it.
    pub const BUSY: Status = Status(-3);
    /// Not within the time given; the device stays usable.
    pub const TIMEOUT: Status = Status(-4);
    /// It was there, and is not any more.
    pub const DISCONNECTED: Status = Status(-5);
    /// It cannot do this at all.
    pub const UNSUPPORTED: Status = Status(-6);
    /// The caller's fault.
    pub const INVALID_ARGUMENT: Status = Status(-7);
    /// Malformed data from the device.
    pub const PROTOCOL: Status = Status(-8);
    /// Beyond a limit of the device.
    pub const OUT_OF_RANGE: Status = Status(-9);
    /// `interrupt` or `halt` ended the call.
    pub const INTERRUPTED: Status = Status(-10);
    /// The device reports a fault, or a number that is not finite.
    pub const DEVICE_FAULT: Status = Status(-11);
    /// The two sides do not understand each other.
    pub const ABI: Status = Status(-12);
    /// Nothing will come any more.
    pub const END_OF_STREAM: Status = Status(-13);
    /// A bug of the plugin, caught; the handle is dead.
    pub const PANICKED: Status = Status(-14);
    /// A bug that was noticed.
    pub const INTERNAL: Status = Status(-15);

    /// Whether the call did what it was asked.
    pub const fn is_ok(self) -> bool {
        self.0 == 0
    }
}
