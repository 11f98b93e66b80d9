//! Comparison of the sideways motion of the tip in a press with the change of the shear force.

use std::fmt;

use taceva_core::{Nanometre, Wrench};

use crate::press::Waypoint;

/// Least change of the shear force that is compared, in multiples of `air_n`.
const FORCE_STEPS: f64 = 5.0;
/// Least change of the shear force that is compared, as a share of the greater of the two shear forces. Slip and relaxation change a force by less,
/// even if the tip moves along the force.
const CHANGED_PART: f64 = 0.75;
/// Least accepted cosine of the angle between the force change and the motion of the tip. Friction and an elastic gel push along the motion. If x and
/// y are swapped, the force is reversed for every motion whose components along x and y have opposite signs.
const ALONG: f64 = -0.25;

/// A waypoint at which the tip rested, with its shear force in N.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sheared {
    depth: Nanometre,
    shear: [Nanometre; 2],
    force_n: [f64; 2],
}

/// Sideways motion of the tip along x and y, and the change of the shear force during this motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShearFault {
    /// Sideways motion of the tip along x and y, in mm.
    pub way_mm: [f64; 2],
    /// Change of the shear force along x and y, in N.
    pub force_n: [f64; 2],
}

impl fmt::Display for ShearFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [way_x, way_y] = self.way_mm;
        let [force_x, force_y] = self.force_n;
        write!(
            f,
            "the tip moved by ({way_x:.3}, {way_y:.3}) mm along x and y, and the shear force changed by ({force_x:.3}, {force_y:.3}) N. Expected a change along the motion, as in the gentle touch, and not against it. Check whether the transducer was turned or its channels swapped, and begin again. Earlier labels of Fx and Fy may be wrong"
        )
    }
}

impl Sheared {
    pub(super) fn at(waypoint: &Waypoint, wrench: &Wrench) -> Sheared {
        let [x, y, _] = wrench.force.map(|force| force.0);
        Sheared {
            depth: waypoint.depth,
            shear: waypoint.shear,
            force_n: [x, y],
        }
    }

    /// Returns the fault if most of the shear force changed against the sideways motion of the tip since `earlier`, at one depth. `air_n` is the
    /// least force that counts as contact in the air, in N.
    pub(super) fn fault(&self, earlier: &Sheared, air_n: f64) -> Option<ShearFault> {
        let axes = [0, 1];
        let way_mm =
            axes.map(|axis| Nanometre(self.shear[axis].0 - earlier.shear[axis].0).to_millimetres());
        let force_n = axes.map(|axis| self.force_n[axis] - earlier.force_n[axis]);
        let length = |[x, y]: [f64; 2]| x.hypot(y);
        let greater_n = length(self.force_n).max(length(earlier.force_n));
        let is_compared = self.depth == earlier.depth
            && length(way_mm) > 0.0
            && length(force_n) > (FORCE_STEPS * air_n).max(CHANGED_PART * greater_n);
        let along = way_mm[0] * force_n[0] + way_mm[1] * force_n[1];
        let is_possible = along >= ALONG * length(way_mm) * length(force_n);
        (is_compared && !is_possible).then_some(ShearFault { way_mm, force_n })
    }
}

#[cfg(test)]
mod tests {
    use taceva_core::{Newton, Phase};

    use super::*;

    fn sheared(depth: i64, shear: [i64; 2], force_n: [f64; 2]) -> Sheared {
        let waypoint = Waypoint {
            depth: Nanometre(depth),
            shear: shear.map(Nanometre),
            phase: Phase::Load,
        };
        let wrench = Wrench {
            force: [force_n[0], force_n[1], 1.0].map(Newton),
            ..Wrench::default()
        };
        Sheared::at(&waypoint, &wrench)
    }

    #[test]
    fn a_shear_force_against_the_way_is_a_fault_and_a_small_one_is_not_compared() {
        let straight = sheared(500_000, [0, 0], [0.01, -0.02]);
        for (shear, force_n, is_fault) in [
            ([300_000, 0], [0.31, -0.01], false),
            ([300_000, 0], [0.31, 0.2], false),
            // A ball that slides over a dome.
            ([300_000, 0], [0.02, 0.3], false),
            // Swapped, or of another sign.
            ([300_000, -200_000], [-0.19, 0.28], true),
            ([300_000, 0], [-0.3, -0.02], true),
            ([-200_000, 200_000], [0.2, -0.2], true),
            // Hidden by noise.
            ([300_000, 0], [-0.05, 0.06], false),
            ([0, 0], [0.01, 0.6], false),
        ] {
            let moved = sheared(500_000, shear, force_n);
            let fault = moved.fault(&straight, 0.02);
            assert_eq!(fault.is_some(), is_fault, "{shear:?}, {force_n:?}");
        }
        // Between two depths the force changes with the normal force.
        let deeper = sheared(600_000, [300_000, 0], [0.0, 0.5]);
        assert_eq!(deeper.fault(&straight, 0.02), None);
    }

    #[test]
    fn a_shear_force_that_slips_or_relaxes_on_its_way_is_no_fault_and_one_that_reverses_is() {
        // A shear at a smaller depth left a force against the way back to straight.
        for (earlier, later, is_fault) in [
            (
                ([300_000, 0], [1.0, 0.0]),
                ([600_000, 0], [0.7, 0.05]),
                false,
            ),
            (([0, 0], [-1.0, 0.1]), ([-300_000, 0], [-0.85, 0.0]), false),
            (([0, 0], [-0.4, 0.0]), ([300_000, 0], [0.8, 0.0]), false),
            (
                ([300_000, 0], [1.0, 0.0]),
                ([600_000, 0], [-0.5, 0.0]),
                true,
            ),
        ] {
            let (shear, force_n) = earlier;
            let earlier = sheared(500_000, shear, force_n);
            let (shear, force_n) = later;
            let fault = sheared(500_000, shear, force_n).fault(&earlier, 0.02);
            assert_eq!(fault.is_some(), is_fault, "{shear:?}, {force_n:?}");
        }
    }
}
