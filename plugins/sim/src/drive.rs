//! The bench as devices: `sim/vitactip`, `sim/magictac`, `sim/gelsight`, `sim/gelsight-wm`, `sim/robot`, `sim/force-transducer` and
//! `sim/lighting`, linked into every program that names this crate.
//!
//! Devices opened with one `rig` argument in one [`Rig`](taceva_core::Rig) share one gel and one virtual clock, [`SimulatedRig`], which
//! runs as fast as the simulation. Time passes while the robot moves, while the transducer averages and until the next frame.
//!
//! Random errors belong to a *visit*, the time from an arrival over a place (or a tare there) to the next. The same visits of a place meet
//! the same errors, whatever happened elsewhere before.

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
