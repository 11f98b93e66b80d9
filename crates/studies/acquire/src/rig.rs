//! Setup of a rig: registration of its robot, latencies, and checks of its devices.

mod certificates;
mod check;
mod listen;
mod problem;
mod stock;
mod stream;
mod switch;
mod tap;
mod teach;
mod weight;

use std::path::Path;

use taceva_protocol::RigFile;

use crate::error::AcquireError;
pub use check::{HaltTrip, RigCheck, check_rig};
pub use problem::RigProblem;
pub use stock::Stock;
pub use stream::Stream;
pub use switch::SwitchCheck;
pub use tap::{RigTap, tap_rig};
pub use teach::teach_rig;
pub use weight::{RigWeight, weigh_rig};

/// Reads the rig file at `path`.
///
/// # Errors
/// [`AcquireError::Scene`] with the line, if the file cannot be read or is invalid.
pub fn read_rig(path: &Path) -> Result<RigFile, AcquireError> {
    crate::scene::read_rig_file(path)
}
