//! `gcode/grbl`: machines with GRBL 1.1 on a serial line.

mod factory;
mod line;
mod machine;
mod motion;

pub use factory::GrblFactory;

use taceva_core::DriverKey;

const KEY: DriverKey = DriverKey::fixed("gcode/grbl");
