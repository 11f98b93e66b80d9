//! The bench as devices: `sim/vitactip`, `sim/magictac`, `sim/gelsight`, `sim/gelsight-wm`, `sim/robot`, `sim/force-transducer` and `sim/lighting`.
//! Every program that links this crate has these drivers.
//!
//! Devices opened with one `rig` argument in one [`Rig`](taceva_core::Rig) share one gel and one virtual clock, [`SimulatedRig`]. The clock advances
//! as fast as the simulation runs: while the robot moves, while the transducer averages, and until the next frame.
//!
//! Random errors belong to a *visit*: the time from an arrival or a tare above a place until the next arrival or tare. The n-th visit to a place
//! always has the same errors, independent of other places.

mod error;
mod force;
mod lighting;
mod place;
mod rig;
mod robot;
mod sensor;
mod specimen;
mod state;
mod ticks;
mod touch;
mod visit;
mod wall;

pub use force::ForceTransducerFactory;
pub use lighting::LightingFactory;
pub use rig::SimulatedRig;
pub use robot::RobotFactory;
pub use sensor::SensorFactory;
pub use specimen::{MountError, Mounted};
