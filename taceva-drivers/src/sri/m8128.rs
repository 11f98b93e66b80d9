//! Driver `sri/m8128`: six-axis force transducers behind an interface box M8128 or similar, over TCP.

mod box_link;
mod command;
mod factory;
mod frame;
mod transducer;

pub use factory::M8128Factory;

use taceva_core::DriverKey;

const KEY: DriverKey = DriverKey::fixed("sri/m8128");
