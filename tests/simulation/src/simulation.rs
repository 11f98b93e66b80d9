//! A rig, its supervisor, its recorder and its faults, driven by one seed: the same seed is the same run, to the last bit.
//!
//! Everything here is simulated: a tip on a spring, a clock that only devices advance, a disk that forgets what was not synced. What is
//! real is the code under test: [`run`](taceva_protocol::run()), [`Supervisor`](taceva_protocol::Supervisor) and the way a run is resumed. (The simulated
//! bench that measures like a sensor is another crate; this one only has to be pressed and to fail.)
//!
//! ```
//! use taceva_simulation::simulation::simulate;
//! let report = simulate(7);
//! assert_eq!(report.violations, []);
//! assert_eq!(simulate(7), report, "a seed replays");
//! ```

mod devices;
mod disk;
mod draws;
mod fault;
mod gel;
mod guard;
mod journal;
mod oracle;
mod record;
mod scenario;
mod switch;
#[cfg(test)]
mod tests;
mod threads;
mod world;
mod world_handle;

pub use fault::{FaultCounts, FaultKind};
pub use oracle::{Checks, HALT_WITHIN_S, Violation};
pub use scenario::{SimulationReport, simulate};
