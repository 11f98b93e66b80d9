//! The bench as devices: `sim/vitactip`, `sim/magictac`, `sim/gelsight`, `sim/gelsight-wm`, `sim/robot`, `sim/force-transducer` and
//! `sim/lighting`, linked into whatever program names this crate.
//!
//! Devices opened with one `rig` argument in one [`Rig`](taceva_core::Rig) work on one gel and share one virtual clock, [`SimulatedRig`]:
//! a second passes as fast as it is worked out. Time passes while the robot moves, while the transducer averages and until the next frame.
//!
//! What is random belongs to a *visit*, the time from an arrival over a place (or a tare there) to the next: the same visits of a place
//! meet the same errors, whatever was done elsewhere before.

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
