#![doc = include_str!("../README.md")]
#![cfg(all(
    target_os = "linux",
    target_pointer_width = "64",
    target_endian = "little"
))]

mod camera;
mod control;
mod error;
mod kernel;
mod mapped;
mod picture;
mod stream;

pub use camera::Camera;
pub use control::{Control, ControlId, ControlKind};
pub use error::V4l2Error;
pub use picture::{Coding, FourCc, GivenFormat, PictureFormat};
pub use stream::{Filled, Stream};
