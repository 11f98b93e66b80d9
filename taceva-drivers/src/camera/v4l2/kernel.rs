//! Linux cameras through the kernel interface Video4Linux, version 2, on 64-bit little-endian machines.
//!
//! Only `ioctls.rs` and `frame_memory.rs` contain `unsafe`.
//!
//! ```rust,no_run
//! use std::time::Duration;
//! use taceva_drivers::camera::v4l2::kernel::{Camera, FourCc, PictureFormat, Stream};
//!
//! let mut camera = Camera::open("/dev/video0")?;
//! let format = camera.set_format(&PictureFormat { width: 640, height: 480, pixels: FourCc::YUYV })?;
//! for control in camera.controls()? {
//!     println!("{}: {} to {}", control.name, control.least, control.greatest);
//! }
//! let mut stream = Stream::start(camera)?;
//! if let Some(frame) = stream.next(Duration::from_secs(1))? {
//!     println!("frame {} of {} bytes, {} expected", frame.number(), frame.bytes().len(), format.bytes);
//! }
//! # Ok::<(), taceva_drivers::camera::v4l2::kernel::V4l2Error>(())
//! ```

mod camera;
mod control;
mod error;
mod frame_memory;
mod ioctls;
mod picture;
mod stream;

pub use camera::Camera;
pub use control::{Control, ControlId, ControlKind};
pub use error::V4l2Error;
pub use picture::{Coding, FourCc, GivenFormat, PictureFormat};
pub use stream::{Filled, Stream};
