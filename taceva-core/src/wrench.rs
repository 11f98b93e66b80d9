//! Forces and torques on the gel.

use crate::geometry::nearest;
use crate::quantity::{Newton, NewtonMillimetre};

/// Force and torque on the gel, in the sensor's frame. A compressing force is positive along z. A plain value, which gets no further fields.
///
/// ```
/// use taceva_core::{Newton, Wrench};
/// let press = Wrench { force: [Newton(0.0), Newton(0.0), Newton(2.5)], ..Wrench::default() };
/// assert_eq!(press.on_grid(), press);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wrench {
    /// Force along x, y, z.
    pub force: [Newton; 3],
    /// Torque about x, y, z.
    pub torque: [NewtonMillimetre; 3],
}

impl Wrench {
    /// The same wrench with each torque rounded to a multiple of 10⁻⁶ N·mm. Forces are unchanged.
    #[must_use]
    pub fn on_grid(self) -> Wrench {
        Wrench {
            force: self.force,
            torque: self
                .torque
                .map(|torque| NewtonMillimetre(nearest(torque.0, 1e6))),
        }
    }
}
