//! Camera drivers, by standard.

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

/// Operation name of a failed capture, for errors.
const CAPTURE: &str = "capture a frame";
