//! The devices of a run, borrowed.

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
}
