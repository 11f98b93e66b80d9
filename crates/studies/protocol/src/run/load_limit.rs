//! Limits of a gel, and the length of the next motion computed from its measured stiffness.

use taceva_core::Wrench;

/// Longest motion before contact is detected, as a share of the greatest depth. Such a motion exceeds no limit.
const UNFELT_PART: f64 = 0.125;
/// Longest motion for which the measured stiffness of a gel is extrapolated, in multiples of the present depth.
const KNOWN_DEPTHS: f64 = 2.0;
/// Upper bound of the mean stiffness over a motion, in multiples of force divided by depth. A sphere (force ∝ depth^1.5) has a factor of 2.1 if a
/// motion triples the depth. Sideways the gel is softer.
const STIFFER: f64 = 3.0;

/// Limits of depth and force on a gel, and the threshold of contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bearing {
    pub(super) depth_max_mm: f64,
    pub(super) normal_max_n: f64,
    pub(super) shear_max_n: f64,
    /// Least force that counts as contact, in N.
    pub(super) threshold_n: f64,
}

/// Last measured normal force and shear force.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Felt {
    pub(super) normal_n: f64,
    pub(super) shear_n: f64,
}

impl Felt {
    pub(super) fn of(wrench: &Wrench) -> Felt {
        let [x, y, z] = wrench.force.map(|force| force.0);
        Felt {
            normal_n: z,
            shear_n: x.hypot(y),
        }
    }
}

impl Bearing {
    /// Longest inward or sideways motion of the tip that exceeds no limit, in mm. It starts at `depth_mm` under the force `felt`.
    pub(super) fn room_mm(&self, depth_mm: f64, felt: &Felt) -> f64 {
        let normal_n = felt.normal_n.abs().max(self.threshold_n);
        let stiffness_n_mm = STIFFER * normal_n / depth_mm.max(0.0);
        let left_n = (self.normal_max_n - normal_n).min(self.shear_max_n - felt.shear_n);
        let by_force_mm = left_n / stiffness_n_mm;
        let by_depth_mm = (self.depth_max_mm - depth_mm).min(KNOWN_DEPTHS * depth_mm);
        by_force_mm.min(by_depth_mm).max(0.0)
    }

    /// Longest motion of the tip that is allowed before contact is detected, in mm.
    pub(super) fn unfelt_mm(&self) -> f64 {
        UNFELT_PART * self.depth_max_mm
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GEL: Bearing = Bearing {
        depth_max_mm: 1.0,
        normal_max_n: 1.8,
        shear_max_n: 1.2,
        threshold_n: 0.02,
    };

    fn pressed(normal_n: f64) -> Felt {
        Felt {
            normal_n,
            shear_n: 0.0,
        }
    }

    #[test]
    fn a_stride_passes_no_limit_of_a_gel_that_a_sphere_is_pressed_into() {
        for hardness in [0.1, 0.5, 1.0, 3.0, 10.0] {
            let force_n = |depth_mm: f64| hardness * depth_mm.powf(1.5);
            let mut depth_mm = 0.01;
            while force_n(depth_mm) < 1.8 && depth_mm < 1.0 {
                let room_mm = GEL.room_mm(depth_mm, &pressed(force_n(depth_mm)));
                let after_mm = depth_mm + room_mm;
                assert!(after_mm <= 1.0 + 1e-12 && force_n(after_mm) <= 1.8 + 1e-9);
                // Least stride of a run.
                depth_mm += room_mm.max(0.015);
            }
        }
    }

    #[test]
    fn at_a_limit_and_at_the_first_contact_there_is_no_room() {
        let sheared = Felt {
            normal_n: 0.5,
            shear_n: 1.2,
        };
        for (depth_mm, felt) in [
            (1.0, pressed(0.5)),
            (0.5, pressed(1.8)),
            (0.5, pressed(2.5)),
            (0.0, pressed(0.5)),
            (0.5, sheared),
        ] {
            assert!(
                GEL.room_mm(depth_mm, &felt) <= 0.0,
                "{depth_mm} mm, {felt:?}"
            );
        }
        // The gel is soft, but measured only to 0.1 mm.
        assert!((GEL.room_mm(0.1, &pressed(0.03)) - 0.2).abs() < 1e-12);
        // 1.2 N of shear are left, at an assumed 6 N/mm.
        assert!((GEL.room_mm(0.3, &pressed(0.6)) - 0.2).abs() < 1e-12);
    }
}
