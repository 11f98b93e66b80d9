//! Kinematics of the arm: six joints with the published parameters of a UR5.

use std::f64::consts::FRAC_PI_2;

use crate::placement::Placement;

/// Link behind a joint, by the convention of Denavit and Hartenberg.
struct Link {
    along_mm: f64,
    across_mm: f64,
    twist_rad: f64,
}

const fn link(along_mm: f64, across_mm: f64, twist_rad: f64) -> Link {
    Link {
        along_mm,
        across_mm,
        twist_rad,
    }
}

const LINKS: [Link; 6] = [
    link(89.159, 0.0, FRAC_PI_2),
    link(0.0, -425.0, 0.0),
    link(0.0, -392.25, 0.0),
    link(109.15, 0.0, FRAC_PI_2),
    link(94.65, 0.0, -FRAC_PI_2),
    link(82.3, 0.0, 0.0),
];

/// Pose of the flange in m and as a rotation vector in rad, for angles in rad.
pub(super) fn pose(angles: [f64; 6]) -> [f64; 6] {
    let base = Placement {
        at_mm: [0.0; 3],
        rows: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    };
    let joints = LINKS.iter().zip(angles);
    let flange = joints.fold(base, |before, (link, angle)| {
        before.then(&link.turned(angle))
    });
    let [x, y, z] = flange.at_mm.map(|side_mm| side_mm / 1e3);
    let [_, _, _, rx, ry, rz] = flange.rotation_vector().map(f64::from);
    [x, y, z, rx, ry, rz]
}

/// Speed of the tip, m/s, at `pose` if only the base joint turned at `speed_rad_s`, rad/s. Emulated joint motions move the tip straight at this
/// speed.
pub(super) fn tip_speed_m_s(pose: [f64; 6], speed_rad_s: f64) -> f64 {
    let [x, y, z, ..] = pose;
    speed_rad_s * x.hypot(y).hypot(z)
}

impl Link {
    fn turned(&self, angle: f64) -> Placement {
        let (sin, cos) = angle.sin_cos();
        let (st, ct) = self.twist_rad.sin_cos();
        Placement {
            at_mm: [self.across_mm * cos, self.across_mm * sin, self.along_mm],
            rows: [
                [cos, -sin * ct, sin * st],
                [sin, cos * ct, -cos * st],
                [0.0, st, ct],
            ],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_flange_of_an_arm_with_all_joints_at_zero_is_where_the_maker_says() {
        let [x, y, z, rx, ry, rz] = pose([0.0; 6]);
        let expected = [-0.817_25, -0.191_45, -0.005_491, FRAC_PI_2, 0.0, 0.0];
        for (found, expected) in [x, y, z, rx, ry, rz].into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-6, "{found} {expected}");
        }
    }
}
