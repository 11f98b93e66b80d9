//! `hid/pedal`: pedals, buttons and hand switches on the USB that a person holds while a robot may move.

mod report;
mod switch;

pub use switch::Pedal;

use taceva_core::DriverKey;

const KEY: DriverKey = DriverKey::fixed("hid/pedal");
