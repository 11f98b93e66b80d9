//! Driver `gcode/marlin`: printers with the firmware Marlin 2 on a serial port.

mod factory;
mod line;
mod machine;
mod motion;

pub use factory::MarlinFactory;

use taceva_core::DriverKey;

use crate::doctor::port_driver::{PortClass, PortDriver};

const KEY: DriverKey = DriverKey::fixed("gcode/marlin");

taceva_core::inventory::submit! {
    PortDriver {
        class: PortClass::Serial,
        key: KEY,
        argument: "port",
        reads: |_, _| true,
    }
}
