//! A rig that is set up: where its robot stands, and whether its devices do what a run needs of them.

mod check;
mod stream;
mod switch;
mod tap;
mod teach;

use std::path::Path;

use taceva_protocol::RigFile;

use crate::error::AcquireError;
pub use check::{HaltTrip, RigCheck, RigProblem, check_rig};
pub use stream::Stream;
pub use switch::SwitchCheck;
pub use tap::{RigTap, tap_rig};
pub use teach::teach_rig;

/// The rig file at `path`.
///
/// # Errors
/// [`AcquireError::Scene`] if it cannot be read or is none, with its line.
pub fn read_rig(path: &Path) -> Result<RigFile, AcquireError> {
    crate::scene::read_rig_file(path)
}
