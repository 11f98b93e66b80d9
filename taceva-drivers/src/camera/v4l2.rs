//! `camera/v4l2`: cameras of this machine, by the kernel's own interface.

mod camera;
mod error;
mod factory;
mod fixed;
mod frames;
pub mod kernel;
mod reader;
mod yuyv;

pub use factory::V4l2Factory;

use taceva_core::DriverKey;

const KEY: DriverKey = DriverKey::fixed("camera/v4l2");
