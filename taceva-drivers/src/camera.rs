//! Camera drivers: one module for each interface standard.

mod crop;
mod jpeg;
#[cfg(feature = "mjpeg")]
pub mod mjpeg;
mod preset;
#[cfg(all(
    feature = "v4l2",
    target_os = "linux",
    target_pointer_width = "64",
    target_endian = "little"
))]
pub mod v4l2;

/// Operation that the error of a failed capture names.
const CAPTURE: &str = "capture a frame";
