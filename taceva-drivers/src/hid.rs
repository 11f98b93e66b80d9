//! HID devices: scales, and pedals that a person holds.

mod listener;
pub mod pedal;
pub mod scale;
mod selection;
