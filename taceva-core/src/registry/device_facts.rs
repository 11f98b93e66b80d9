//! What is known about a device before it is connected.

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

/// The facts of a device of each kind. A fact that is `None` is not known, and none is assumed in its place.
///
/// ```
/// use taceva_core::{DriverKind, Facts, RobotFacts};
/// assert_eq!(Facts::Robot(RobotFacts::default()).kind(), DriverKind::Robot);
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Facts {
    /// Of a sensor.
    Sensor(Box<SensorFacts>),
    /// Of a robot.
    Robot(RobotFacts),
    /// Of a force transducer.
    Force(ForceFacts),
    /// Of a lighting.
    Lighting(LightingFacts),
    /// Of a changer.
    Changer(ChangerFacts),
}

impl Facts {
    /// The kind they are facts of.
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
