//! Driver `ur/rtde`: arms of Universal Robots. It reads states by the real-time data exchange (RTDE) and moves the arm by script programs.

mod arm;
mod expiring;
mod factory;
mod message;
mod motion;
mod rotation;
mod safety;
mod script;
mod states;

pub use factory::UrFactory;

use taceva_core::DriverKey;

const KEY: DriverKey = DriverKey::fixed("ur/rtde");
