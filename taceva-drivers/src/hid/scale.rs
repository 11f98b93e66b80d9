//! `hid/scale`: scales on the USB that speak the usage page of weighing devices.

mod factory;
mod report;
mod transducer;

pub use factory::ScaleFactory;

use taceva_core::DriverKey;

const KEY: DriverKey = DriverKey::fixed("hid/scale");
