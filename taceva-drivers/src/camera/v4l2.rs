//! `camera/v4l2`: local cameras, through the kernel interface Video4Linux.

mod camera;
mod error;
mod factory;
mod fixed;
mod frames;
pub mod kernel;
mod leds;
mod reader;
mod yuyv;

pub use factory::V4l2Factory;

use taceva_core::DriverKey;

use crate::doctor::Machine;
use crate::doctor::port_driver::{PortClass, PortDriver};

const KEY: DriverKey = DriverKey::fixed("camera/v4l2");

taceva_core::inventory::submit! {
    PortDriver {
        class: PortClass::Camera,
        key: KEY,
        argument: "device",
        reads: is_first_file,
    }
}

/// True for the first device file of a camera. Further files give no images. Also true if the system does not number the files.
fn is_first_file(machine: &Machine, name: &str) -> bool {
    let index = machine.text(&format!("sys/class/video4linux/{name}/index"));
    index.is_none_or(|index| index == "0")
}
