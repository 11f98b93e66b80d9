//! Devices that speak HID: scales, and pedals that a person holds.

mod listener;
mod pedal;
mod scale;
mod selected;

pub use pedal::Pedal;
pub use scale::ScaleFactory;
