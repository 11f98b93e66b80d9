//! `hid/pedal`: USB pedals, buttons and hand switches that a person holds while a robot may move.

mod report;
mod switch;

pub use switch::Pedal;

use std::sync::Arc;

use taceva_core::DriverKey;

use crate::switches::LinkedSwitch;

const KEY: DriverKey = DriverKey::fixed("hid/pedal");

taceva_core::inventory::submit! {
    LinkedSwitch {
        key: KEY,
        title: "a USB pedal, button or hand switch",
        arguments: Pedal::arguments,
        open: |selector| Ok(Arc::new(Pedal::open(selector)?)),
    }
}
