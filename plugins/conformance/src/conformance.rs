//! The contract of every driver, as checks: run a factory through them and read the [`Report`].
//!
//! The suites check the contract of [`Sensor`](taceva_core::Sensor), [`Robot`](taceva_core::Robot),
//! [`ForceTransducer`](taceva_core::ForceTransducer), [`Lighting`](taceva_core::Lighting) and [`Changer`](taceva_core::Changer): that the descriptor states the
//! truth, deadlines are kept, a halt from another thread stops and latches, numbers that are not finite are refused, and calls
//! out of order are answered with a typed error. Each check opens the device anew.
//!
//! **A robot moves**: by [`Trial::travel`] away from the gel and back. **A changer moves**: it brings what it holds. Nothing else moves, and no check presses the gel.
//!
//! ```
//! use taceva_conformance::{self as conformance, Trial};
//! use taceva_drivers::ReplayFactory;
//! # let folder = tempfile::tempdir()?;
//! # for name in ["1.png", "2.png", "3.png", "4.png"] {
//! #     image::GrayImage::from_pixel(4, 3, image::Luma([7])).save(folder.path().join(name))?;
//! # }
//! # let folder = folder.path().display();
//! let trial = Trial::with_arguments(format!("folder={folder};repeat=true"));
//! let report = conformance::sensor(&ReplayFactory::new()?, &trial);
//! assert!(report.passed(), "{report}");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bench;
mod changer;
mod force;
mod lighting;
mod report;
mod robot;
mod sensor;

pub use changer::changer;
pub use force::force;
pub use lighting::lighting;
pub use report::{Check, Outcome, Report};
pub use robot::robot;
pub use sensor::sensor;

use std::time::Duration;

use taceva_core::{Deadline, Millimetre};

/// How a driver is tried.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// The arguments it is opened with, as they stand behind the colon of a selector.
    pub arguments: String,
    /// The deadline of calls that should succeed, in the time of the device.
    pub deadline: Deadline,
    /// How long a call that should return at once may take on the clock of the machine.
    pub at_once: Duration,
    /// How far a robot is moved away from the gel.
    pub travel: Millimetre,
}

impl Trial {
    /// A trial with `arguments`: a second for what should succeed, half a second for what should return at once, 0.5 mm of travel.
    pub fn with_arguments(arguments: impl Into<String>) -> Trial {
        Trial {
            arguments: arguments.into(),
            deadline: Deadline::after(Duration::from_secs(1)),
            at_once: Duration::from_millis(500),
            travel: Millimetre(0.5),
        }
    }
}

impl Default for Trial {
    fn default() -> Trial {
        Trial::with_arguments("")
    }
}
