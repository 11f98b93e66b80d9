//! `ati/netft`: six-axis transducers behind a Net F/T box, by its raw data transfer over UDP.

mod calibration;
mod factory;
mod record;
mod stream;
mod transducer;

pub use factory::NetftFactory;

use taceva_core::DriverKey;

const KEY: DriverKey = DriverKey::fixed("ati/netft");
