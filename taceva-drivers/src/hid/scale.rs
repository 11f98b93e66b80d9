//! `hid/scale`: USB scales with the HID usage page of weighing devices.

mod factory;
mod report;
mod transducer;

pub use factory::ScaleFactory;

use taceva_core::DriverKey;

use crate::doctor::Machine;
use crate::doctor::port_driver::{PortClass, PortDriver};

const KEY: DriverKey = DriverKey::fixed("hid/scale");

taceva_core::inventory::submit! {
    PortDriver {
        class: PortClass::Hid,
        key: KEY,
        argument: "device",
        reads: is_scale,
    }
}

/// First bytes of a scale's report descriptor: usage page 0x8D, usage 0x20.
const SCALE: &[u8] = &[0x05, 0x8d, 0x09, 0x20];

fn is_scale(machine: &Machine, name: &str) -> bool {
    let path = format!("sys/class/hidraw/{name}/device/report_descriptor");
    std::fs::read(machine.path(&path)).is_ok_and(|found| found.starts_with(SCALE))
}
