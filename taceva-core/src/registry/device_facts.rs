//! Properties of a device, known before it is opened.

mod changer;
mod force;
mod lighting;
mod robot;
mod sensor;
mod workspace;

use crate::driver::DriverKind;

pub use changer::ChangerFacts;
pub use force::ForceFacts;
pub use lighting::LightingFacts;
pub use robot::RobotFacts;
pub use sensor::SensorFacts;
pub use workspace::Workspace;

/// Properties of a device that are known before it is opened. A property that is `None` is unknown, and programs must not assume a value.
///
/// ```
/// use taceva_core::{DriverKind, Facts, RobotFacts};
/// assert_eq!(Facts::Robot(RobotFacts::default()).kind(), DriverKind::Robot);
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Facts {
    /// Properties of a sensor.
    Sensor(Box<SensorFacts>),
    /// Properties of a robot.
    Robot(RobotFacts),
    /// Properties of a force transducer.
    Force(ForceFacts),
    /// Properties of a lighting device.
    Lighting(LightingFacts),
    /// Properties of a changer, which brings specimens or sensor units into place.
    Changer(ChangerFacts),
}

impl Facts {
    /// Kind of the device that has these properties.
    pub fn kind(&self) -> DriverKind {
        match self {
            Facts::Sensor(_) => DriverKind::Sensor,
            Facts::Robot(_) => DriverKind::Robot,
            Facts::Force(_) => DriverKind::Force,
            Facts::Lighting(_) => DriverKind::Lighting,
            Facts::Changer(_) => DriverKind::Changer,
        }
    }
}
