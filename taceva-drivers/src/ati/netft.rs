//! `ati/netft`: six-axis transducers that a Net F/T box connects, read by its raw data transfer (RDT) over UDP.

mod calibration;
mod factory;
mod page;
mod record;
mod setup;
mod status;
mod stream;
mod transducer;

pub use factory::NetftFactory;

use taceva_core::DriverKey;

const KEY: DriverKey = DriverKey::fixed("ati/netft");
