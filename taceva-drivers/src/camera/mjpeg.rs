//! `camera/mjpeg`: cameras that stream images in one HTTP response of type `multipart/x-mixed-replace`.

mod body;
mod camera;
mod camera_clock;
mod factory;
mod head;
mod parts;
mod stream;
mod url;

pub use factory::MjpegFactory;

use taceva_core::DriverKey;

const KEY: DriverKey = DriverKey::fixed("camera/mjpeg");
