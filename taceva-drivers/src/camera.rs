//! Cameras by the standards that they speak.

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

/// What a camera does when a picture is no frame.
const CAPTURE: &str = "capture a frame";
