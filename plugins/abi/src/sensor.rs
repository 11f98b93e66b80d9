//! Function table of a sensor.

use core::ffi::c_void;

use crate::device::{DeviceCalls, Stamp};
use crate::error::Error;
use crate::status::Status;

/// Storage format of one pixel. A number rather than an enum, so that a later version of the interface can add a format. An older host rejects a new
/// format.
///
/// ```
/// use taceva_abi::PixelFormat;
/// assert_eq!(PixelFormat::RGB8, PixelFormat(3));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(transparent)]
pub struct PixelFormat(pub u32);

impl PixelFormat {
    /// One byte per pixel.
    pub const GRAY8: PixelFormat = PixelFormat(1);
    /// Two bytes per pixel, little-endian.
    pub const GRAY16: PixelFormat = PixelFormat(2);
    /// Three bytes per pixel.
    pub const RGB8: PixelFormat = PixelFormat(3);
    /// Three numbers of two bytes per pixel, little-endian.
    pub const RGB16: PixelFormat = PixelFormat(4);
}

/// Flag: the device lost frames between the last frame and this frame.
pub const FRAME_DROPPED: u32 = 1;
/// Flag: the device assigned `sequence`, so a gap means lost frames. Without the flag, `sequence` only counts captured frames. Since minor 4.
pub const FRAME_NUMBERED: u32 = 2;

/// `taceva_frame`: a picture, row by row from the top, without padding.
///
/// New versions append fields. Each side reads at most the bytes that the other side's `size` states.
///
/// ```
/// use taceva_abi::{Frame, PixelFormat, Stamp};
/// let mut pixels = [0_u8; 64 * 48];
/// let frame = Frame {
///     size: size_of::<Frame>() as u32,
///     format: PixelFormat(0), // the plugin fills this in
///     width: 0,
///     height: 0,
///     flags: 0,
///     reserved: 0,
///     sequence: 0,
///     stamp: Stamp::default(),
///     buffer: pixels.as_mut_ptr(),
///     buffer_length: pixels.len() as u64,
///     data: std::ptr::null(),
///     length: 0,
///     release: None,
///     private_data: std::ptr::null_mut(),
/// };
/// assert_eq!(frame.buffer_length, 3_072);
/// ```
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Frame {
    /// Size of this struct, bytes.
    pub size: u32,
    /// Storage format of one pixel.
    pub format: PixelFormat,
    /// Pixels per row.
    pub width: u32,
    /// Rows of pixels.
    pub height: u32,
    /// [`FRAME_DROPPED`] and [`FRAME_NUMBERED`], or 0.
    pub flags: u32,
    /// Reserved, 0.
    pub reserved: u32,
    /// Frame number, which increases with each frame. With [`FRAME_NUMBERED`], a gap means lost frames.
    pub sequence: u64,
    /// Times of the frame. A frame is valid at the middle of the exposure, if known.
    pub stamp: Stamp,
    /// In: buffer of the caller, or NULL.
    pub buffer: *mut u8,
    /// In: length of the buffer, bytes.
    pub buffer_length: u64,
    /// Out: first byte of the pixels, in `buffer` or in lent memory.
    pub data: *const u8,
    /// Out: length of `data`, bytes.
    pub length: u64,
    /// Out: `[any]` function that releases lent memory and sets this field to NULL. NULL if no memory is lent.
    pub release: Option<unsafe extern "C" fn(frame: *mut Frame)>,
    /// Data for the plugin while it lends the frame. The host does not change the field.
    pub private_data: *mut c_void,
}

/// `taceva_sensor_calls`: functions of a sensor.
///
/// New versions append fields. Each side reads at most the bytes that the other side's `size` states.
///
/// ```
/// use taceva_abi::{DeviceCalls, SensorCalls};
/// let device = DeviceCalls { size: size_of::<SensorCalls>() as u32, reserved: 0, close: None, interrupt: None, extension: None };
/// let calls = SensorCalls { device, max_lent: 0, reserved: 0, start: None, capture: None, stop: None };
/// assert_eq!(calls.max_lent, 0, "it never lends its frames");
/// ```
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct SensorCalls {
    /// Calls that every device has. The table begins with them.
    pub device: DeviceCalls,
    /// Maximum number of frames that the sensor lends at once; 0 if the sensor never lends.
    pub max_lent: u32,
    /// Reserved, 0.
    pub reserved: u32,
    /// `[owner & open]` Starts the frames; idempotent.
    pub start: Option<unsafe extern "C" fn(*mut c_void, timeout_ns: u64, *mut Error) -> Status>,
    /// `[owner & started]` Waits for the next frame and writes it.
    pub capture: Option<
        unsafe extern "C" fn(*mut c_void, *mut Frame, timeout_ns: u64, *mut Error) -> Status,
    >,
    /// `[owner & open]` Stops the frames; idempotent.
    pub stop: Option<unsafe extern "C" fn(*mut c_void, *mut Error) -> Status>,
}
