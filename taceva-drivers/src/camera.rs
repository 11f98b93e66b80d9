//! Cameras by the standards that they speak.

mod mjpeg;

pub use mjpeg::MjpegFactory;
