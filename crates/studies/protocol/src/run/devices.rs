//! The devices of a run, borrowed.

use std::time::Duration;

use taceva_core::{Deadline, DriverError, ForceTransducer, Lighting, Robot, Sensor, Specimen};

/// What a run works with; it starts and stops them, and owns none.
pub struct Devices<'a> {
    /// Carries the specimen.
    pub robot: &'a mut dyn Robot,
    /// Measures the force.
    pub force: &'a mut dyn ForceTransducer,
    /// Gives pictures; absent where none is taken.
    pub sensor: Option<&'a mut dyn Sensor>,
    /// Sets the light; where absent, the sensor's own ability is used.
    pub lighting: Option<&'a mut dyn Lighting>,
    /// Exchanges specimens; where absent, one specimen serves the whole run.
    pub specimens: Option<&'a mut dyn SpecimenChanger>,
}

/// Exchanges what the robot carries: a tool changer, a simulated bench, or a person who is asked.
pub trait SpecimenChanger {
    /// Mounts `specimen`, turned straight, and returns once it can be pressed. The tip is far from the gel.
    ///
    /// # Errors
    /// [`DriverError`] if it is not there or was not mounted in time.
    fn mount(&mut self, specimen: Specimen, deadline: Deadline) -> Result<(), DriverError>;

    /// Whether it has `specimen`; what it has not is mounted by hand.
    fn holds(&self, _specimen: Specimen) -> bool {
        true
    }

    /// How long it may move to mount one: the robot is halted meanwhile. `None` of one in which nothing moves, such as a simulated bench.
    fn patience(&self) -> Option<Duration> {
        None
    }
}
