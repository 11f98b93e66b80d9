//! Borrowed devices of a run.

use std::time::Duration;

use taceva_core::{Deadline, DriverError, ForceTransducer, Lighting, Robot, Sensor, Specimen};

/// Borrowed devices of a run, which starts and stops them.
pub struct Devices<'a> {
    /// Robot with the specimen.
    pub robot: &'a mut dyn Robot,
    /// Force transducer.
    pub force: &'a mut dyn ForceTransducer,
    /// Sensor; `None` if the plan needs no frames.
    pub sensor: Option<&'a mut dyn Sensor>,
    /// Lighting; `None` if the sensor sets the light.
    pub lighting: Option<&'a mut dyn Lighting>,
    /// Changer of specimens; `None` if an operator changes them, or if the plan has only one specimen.
    pub specimens: Option<&'a mut dyn SpecimenChanger>,
}

/// Changer of the specimen on the robot: a tool changer, a simulated bench, or an operator.
pub trait SpecimenChanger {
    /// Mounts `specimen` without rotation, and returns when it is ready to press. The tip is far from the gel.
    ///
    /// # Errors
    /// [`DriverError`] if the specimen is missing or was not mounted in time.
    fn mount(&mut self, specimen: Specimen, deadline: Deadline) -> Result<(), DriverError>;

    /// True if the changer has `specimen` ready to mount. The operator mounts other specimens.
    fn holds(&self, _specimen: Specimen) -> bool {
        true
    }

    /// Longest time for a change, during which the robot is halted. `None` for a changer without moving parts, such as a simulated bench.
    fn patience(&self) -> Option<Duration> {
        None
    }
}
