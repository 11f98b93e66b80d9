//! Devices of a library in this process, behind the device traits of `taceva_core`.

mod bench;
mod changer;
mod force;
mod handle;
mod lighting;
mod rig;
mod robot;
mod sensor;

pub(crate) use self::bench::PluginBench;
pub(crate) use self::changer::PluginChanger;
pub(crate) use self::force::PluginForce;
pub(crate) use self::handle::PluginDevice;
pub use self::handle::{Handle, Opened, Owned, open};
pub(crate) use self::lighting::PluginLighting;
pub use self::rig::RigHandle;
pub(crate) use self::robot::PluginRobot;
pub use self::sensor::{LentFrame, PluginSensor};
