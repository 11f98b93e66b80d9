//! Facts about a device before it is connected.

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

/// Facts of a device, by kind. A fact that is `None` is unknown, and readers must not assume a value.
///
/// ```
/// use taceva_core::{DriverKind, Facts, RobotFacts};
/// assert_eq!(Facts::Robot(RobotFacts::default()).kind(), DriverKind::Robot);
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Facts {
    /// Facts of a sensor.
    Sensor(Box<SensorFacts>),
    /// Facts of a robot.
    Robot(RobotFacts),
    /// Facts of a force transducer.
    Force(ForceFacts),
    /// Facts of a lighting device.
    Lighting(LightingFacts),
    /// Facts of a changer.
    Changer(ChangerFacts),
}

impl Facts {
    /// Kind of the device.
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
