//! Driver `gcode/grbl`: machines with the firmware GRBL 1.1 on a serial port.

mod factory;
mod line;
mod machine;
mod motion;

pub use factory::GrblFactory;

use taceva_core::DriverKey;

use crate::doctor::port_driver::{PortClass, PortDriver};

const KEY: DriverKey = DriverKey::fixed("gcode/grbl");

taceva_core::inventory::submit! {
    PortDriver {
        class: PortClass::Serial,
        key: KEY,
        argument: "port",
        reads: |_, _| true,
    }
}
