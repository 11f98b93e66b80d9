//! Cameras by the standards that they speak.

mod crop;
mod jpeg;
#[cfg(feature = "mjpeg")]
mod mjpeg;
mod preset;
#[cfg(all(
    feature = "v4l2",
    target_os = "linux",
    target_pointer_width = "64",
    target_endian = "little"
))]
mod v4l2;

#[cfg(feature = "mjpeg")]
pub use mjpeg::MjpegFactory;
#[cfg(all(
    feature = "v4l2",
    target_os = "linux",
    target_pointer_width = "64",
    target_endian = "little"
))]
pub use v4l2::{V4l2Factory, kernel as v4l2_kernel};

/// What a camera does when a picture is no frame.
const CAPTURE: &str = "capture a frame";
