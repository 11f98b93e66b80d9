//! Simulated rig, supervisor, recorder and faults, driven by one seed: the same seed gives the same run, bit for bit.
//!
//! The simulation has a tip on a spring, a clock that only devices advance, and a disk that forgets unsynced data. The code under test is real:
//! [`run`](taceva_protocol::run()), [`Supervisor`](taceva_protocol::Supervisor) and the resumption of a run. The simulated bench with sensors is in another
//! crate.
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
