//! HID devices: scales as force transducers, and pedals as enabling switches.

mod listener;
pub mod pedal;
pub mod scale;
mod selection;
