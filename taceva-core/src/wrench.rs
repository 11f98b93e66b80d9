//! What the force transducer says.

use crate::quantity::{Newton, NewtonMillimetre};

/// Force and torque on the gel, in the sensor's frame; a compressing force has a positive z.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wrench {
    /// Force along x, y, z.
    pub force: [Newton; 3],
    /// Torque about x, y, z.
    pub torque: [NewtonMillimetre; 3],
}
