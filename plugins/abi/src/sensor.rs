//! The calls of a sensor.

use core::ffi::c_void;

use crate::device::{DeviceCalls, Stamp};
use crate::error::Error;
use crate::status::Status;

/// How one pixel is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(transparent)]
pub struct PixelFormat(pub u32);

impl PixelFormat {
    /// One byte a pixel.
    pub const GRAY8: PixelFormat = PixelFormat(1);
    /// Two bytes a pixel, little-endian.
    pub const GRAY16: PixelFormat = PixelFormat(2);
    /// Three bytes a pixel.
    pub const RGB8: PixelFormat = PixelFormat(3);
    /// Three numbers of two bytes, little-endian.
    pub const RGB16: PixelFormat = PixelFormat(4);
}

/// Flag: frames were lost since the last one.
pub const FRAME_DROPPED: u32 = 1;

/// `taceva_frame`: a picture, row by row from the top, without padding.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Frame {
    /// Of this struct.
    pub size: u32,
    /// How one pixel is stored.
    pub format: PixelFormat,
    /// Pixels a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// [`FRAME_DROPPED`].
    pub flags: u32,
    /// 0.
    pub reserved: u32,
    /// The device's count of frames; a gap is a loss.
    pub sequence: u64,
    /// Valid: mid of the exposure, where it is known.
    pub stamp: Stamp,
    /// In: the caller's buffer, or NULL.
    pub buffer: *mut u8,
    /// In: its length.
    pub buffer_length: u64,
    /// Out: the pixels, in `buffer` or lent.
    pub data: *const u8,
    /// Out: how many bytes.
    pub length: u64,
    /// Out: `[any]` gives lent memory back and sets itself to NULL.
    pub release: Option<unsafe extern "C" fn(frame: *mut Frame)>,
    /// The lender's.
    pub private_data: *mut c_void,
}

/// `taceva_sensor_calls`.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct SensorCalls {
    /// What every device has.
    pub device: DeviceCalls,
    /// Frames that may be out at once; 0: it never lends.
    pub max_lent: u32,
    /// 0.
    pub reserved: u32,
    /// `[owner & open]` Idempotent.
    pub start: Option<unsafe extern "C" fn(*mut c_void, timeout_ns: u64, *mut Error) -> Status>,
    /// `[owner & started]` The next frame.
    pub capture: Option<
        unsafe extern "C" fn(*mut c_void, *mut Frame, timeout_ns: u64, *mut Error) -> Status,
    >,
    /// `[owner & open]` Idempotent.
    pub stop: Option<unsafe extern "C" fn(*mut c_void, *mut Error) -> Status>,
}
