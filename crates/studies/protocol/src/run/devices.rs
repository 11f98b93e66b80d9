//! The devices of a run, borrowed.

use std::time::Duration;

use taceva_core::{Deadline, DriverError, ForceTransducer, Lighting, Robot, Sensor, Specimen};

/// Borrowed devices of a run, which starts and stops them.
pub struct Devices<'a> {
    /// Carries the specimen.
    pub robot: &'a mut dyn Robot,
    /// Measures the force.
    pub force: &'a mut dyn ForceTransducer,
    /// Takes pictures; `None` if the plan takes none.
    pub sensor: Option<&'a mut dyn Sensor>,
    /// Sets the light; `None` leaves this to the sensor.
    pub lighting: Option<&'a mut dyn Lighting>,
    /// Changes specimens; with `None`, one specimen serves the whole run.
    pub specimens: Option<&'a mut dyn SpecimenChanger>,
}

/// Changes the specimen on the robot: a tool changer, a simulated bench, or a person.
pub trait SpecimenChanger {
    /// Mounts `specimen`, turned straight, and returns once it can be pressed. The tip is far from the gel.
    ///
    /// # Errors
    /// [`DriverError`] if it is missing or was not mounted in time.
    fn mount(&mut self, specimen: Specimen, deadline: Deadline) -> Result<(), DriverError>;

    /// True if the changer holds `specimen`; others are mounted by hand.
    fn holds(&self, _specimen: Specimen) -> bool {
        true
    }

    /// Longest duration of one mount; the robot is halted meanwhile. `None` for a changer without moving parts, such as a simulated bench.
    fn patience(&self) -> Option<Duration> {
        None
    }
}
