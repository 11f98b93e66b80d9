//! Radial functions of one press.

use super::index::{NODES, Place, Radial, locate, node};
use super::load::Load;
use super::radial::Quantity;
use crate::number::narrow;

/// Radial functions of one press, with lengths in mm. A profile can be reused for later presses.
#[derive(Clone, Debug)]
pub struct Profile {
    radius_mm: f64,
    inverse_radius_squared: f32,
    tables: Box<[Radial; Quantity::ALL.len()]>,
}

impl Default for Profile {
    fn default() -> Profile {
        Profile::new()
    }
}

impl Profile {
    /// Creates a profile without displacement.
    pub fn new() -> Profile {
        Profile {
            radius_mm: 1.0,
            inverse_radius_squared: 1.0,
            tables: Box::new([[0.0; NODES]; Quantity::ALL.len()]),
        }
    }

    /// Table of one function, with a value at each [`node`]. [`Quantity::Sink`] and [`Quantity::Along`] are in mm; each division by the radius and
    /// each derivative divides the unit by mm.
    pub fn table(&self, quantity: Quantity) -> &Radial {
        &self.tables[quantity as usize]
    }

    /// 1/a² for the contact radius a, 1/mm². The argument of [`locate`] at the radius r is t = 1 + r² times this value.
    pub fn inverse_radius_squared(&self) -> f32 {
        self.inverse_radius_squared
    }

    /// Position of a squared radius in the tables.
    #[inline(always)]
    pub fn locate(&self, radius_squared_mm2: f32) -> Place {
        locate(1.0 + radius_squared_mm2 * self.inverse_radius_squared)
    }

    /// Radius beyond which the magnitude of the function is at most `least`, in mm; 0 if it never exceeds `least`.
    pub fn reach(&self, quantity: Quantity, least: f32) -> f64 {
        let table = self.table(quantity);
        let last = table.iter().rposition(|value| value.abs() > least);
        last.map_or(0.0, |last| {
            self.radius_mm * (node((last + 1).min(NODES - 1)) - 1.0).sqrt()
        })
    }

    pub(super) fn clear(&mut self) {
        for table in self.tables.iter_mut() {
            table.fill(0.0);
        }
    }

    pub(super) fn set_radius(&mut self, radius_mm: f64) {
        self.radius_mm = radius_mm;
        self.inverse_radius_squared = narrow(1.0 / (radius_mm * radius_mm));
    }

    pub(super) fn table_mut(&mut self, quantity: Quantity) -> &mut Radial {
        &mut self.tables[quantity as usize]
    }

    /// Fits the sink to the ball inside the contact, and scales it outside to match at the rim.
    pub(super) fn follow_ball(&mut self, load: &Load) {
        let curvature = 1.0 / load.indenter_radius_mm;
        let squared = self.radius_mm * self.radius_mm;
        let at_rim = load.depth_mm - 0.5 * squared * curvature;
        let rim = RIM;
        let scale = at_rim / f64::from(self.table(Quantity::Sink)[rim]);
        // Ball and layer agree to some per cent. A pressure far from Hertz's gives no usable ratio at the rim.
        let scale = if (0.5..2.0).contains(&scale) {
            narrow(scale)
        } else {
            1.0
        };
        for quantity in [Quantity::Sink, Quantity::SinkSlope] {
            for value in &mut self.table_mut(quantity)[rim..] {
                *value *= scale;
            }
        }
        for position in 0..=rim {
            let radius_squared = (node(position) - 1.0) * squared;
            let sink = load.depth_mm - 0.5 * radius_squared * curvature;
            self.table_mut(Quantity::Sink)[position] = narrow(sink);
        }
        self.table_mut(Quantity::SinkSlope)[..rim].fill(narrow(-curvature));
    }
}

/// Node at the rim of the contact, where the radius equals the contact radius.
const RIM: usize = (NODES - 1) / 12;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rim_is_a_node() {
        assert_eq!(node(RIM).to_bits(), 2.0_f64.to_bits());
    }
}
