//! What a gel bears, and how far it may be pressed on at once by what it has shown of its stiffness.

use taceva_core::Wrench;

/// From a tip that feels nothing, this part of the depth that the gel is pressed to passes no limit of it.
const UNFELT_PART: f64 = 0.125;
/// So many times as deep as it has been felt, a gel is taken to be known ...
const KNOWN_DEPTHS: f64 = 2.0;
/// ... to so many times the stiffness that its force by its depth is: pressed by a sphere it is as stiff as that to six times the depth (force
/// by depth to the power of 1.5), and to the side it is softer.
const STIFFER: f64 = 3.0;

/// What a gel bears.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bearing {
    pub(super) depth_max_mm: f64,
    pub(super) normal_max_n: f64,
    pub(super) shear_max_n: f64,
    /// Less than this is nothing.
    pub(super) threshold_n: f64,
}

/// What was felt last, in N.
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
    /// How far the tip may go on at once, inward or aside, in a gel that is felt so at `depth_mm`, in mm.
    pub(super) fn room_mm(&self, depth_mm: f64, felt: &Felt) -> f64 {
        let normal_n = felt.normal_n.abs().max(self.threshold_n);
        let stiffness_n_mm = STIFFER * normal_n / depth_mm.max(0.0);
        let left_n = (self.normal_max_n - normal_n).min(self.shear_max_n - felt.shear_n);
        let by_force_mm = left_n / stiffness_n_mm;
        let by_depth_mm = (self.depth_max_mm - depth_mm).min(KNOWN_DEPTHS * depth_mm);
        by_force_mm.min(by_depth_mm).max(0.0)
    }

    /// How far the tip may go at once that feels nothing.
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
                // As a run goes on where there is no room.
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
        // Soft as it is, it was felt to a tenth of a millimetre alone.
        assert!((GEL.room_mm(0.1, &pressed(0.03)) - 0.2).abs() < 1e-12);
        // 1.2 N to the side are left of a gel that is taken to be of 6 N/mm.
        assert!((GEL.room_mm(0.3, &pressed(0.6)) - 0.2).abs() < 1e-12);
    }
}
