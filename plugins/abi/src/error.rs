//! Message of a failure, in the caller's memory.

use core::ffi::c_char;
use core::mem::size_of;

/// Length of a message with its NUL, bytes.
pub const MESSAGE_SIZE: usize = 504;

/// `taceva_error`: failure of a call.
///
/// New versions append fields. Each side reads at most the bytes that the other side's `size` states.
///
/// ```
/// use taceva_abi::{Error, Status};
/// fn open(error: &mut Error) -> Status {
///     error.write("no camera is plugged in");
///     Status::NOT_FOUND
/// }
/// let mut error = Error::new();
/// assert_eq!(open(&mut error), Status::NOT_FOUND);
/// assert_eq!(error.bytes().collect::<Vec<_>>(), b"no camera is plugged in");
/// ```
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Error {
    /// In: size of this struct, bytes.
    pub size: u32,
    /// Out: error number of the device, 0 for none.
    pub vendor_code: i32,
    /// Out: UTF-8 text with a final NUL, truncated to the size of this field.
    pub message: [c_char; MESSAGE_SIZE],
    /// Out, since minor 1: reason for which the device stopped by itself. A plugin writes this field only if `size` covers the field.
    pub fault: FaultNumber,
}

/// `taceva_fault`: fault for which a device stopped by itself. The device moves again only after a person has checked it.
///
/// A number rather than an enum, because a plugin may write any number. An unlisted number with the same upper 16 bits counts as
/// [`SERVO`](FaultNumber::SERVO), never as no fault. No text begins with these bits, so a message of an old plugin that overran into this field is no
/// fault.
///
/// ```
/// use taceva_abi::{Error, FaultNumber};
/// assert_eq!(Error::new().fault, FaultNumber::NONE);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[repr(transparent)]
pub struct FaultNumber(pub u32);

impl FaultNumber {
    /// The device did not stop by itself.
    pub const NONE: FaultNumber = FaultNumber(0);
    /// An emergency stop was pressed, or a safety guard opened.
    pub const EMERGENCY_STOP: FaultNumber = FaultNumber(0xfa17_0001);
    /// The device struck something.
    pub const COLLISION: FaultNumber = FaultNumber(0xfa17_0002);
    /// The device reached a boundary of its workspace.
    pub const BOUNDARY: FaultNumber = FaultNumber(0xfa17_0003);
    /// A servo, a brake or its controller failed.
    pub const SERVO: FaultNumber = FaultNumber(0xfa17_0004);

    /// True for a fault, listed or not.
    pub const fn is_fault(self) -> bool {
        self.0 >> 16 == FaultNumber::SERVO.0 >> 16
    }
}

impl Error {
    /// An error without a message.
    pub const fn new() -> Error {
        #[expect(clippy::cast_possible_truncation, reason = "516")]
        let size = size_of::<Error>() as u32;
        Error {
            size,
            vendor_code: 0,
            message: [0; MESSAGE_SIZE],
            fault: FaultNumber::NONE,
        }
    }

    /// Writes a message. Truncates a too long message between two characters.
    pub fn write(&mut self, message: &str) {
        let mut end = message.len().min(MESSAGE_SIZE - 1);
        while !message.is_char_boundary(end) {
            end -= 1;
        }
        for (place, byte) in self.message.iter_mut().zip(&message.as_bytes()[..end]) {
            *place = c_char::from_ne_bytes([*byte]);
        }
        self.message[end] = 0;
    }

    /// Bytes of the message before its NUL, or all bytes if there is no NUL.
    pub fn bytes(&self) -> impl Iterator<Item = u8> + '_ {
        self.message
            .iter()
            .map(|byte| byte.to_ne_bytes()[0])
            .take_while(|byte| *byte != 0)
    }
}

impl Default for Error {
    fn default() -> Error {
        Error::new()
    }
}
