//! `gcode/marlin`: printers with Marlin 2 on a serial line.

mod factory;
mod line;
mod machine;
mod motion;

pub use factory::MarlinFactory;

use taceva_core::DriverKey;

const KEY: DriverKey = DriverKey::fixed("gcode/marlin");
