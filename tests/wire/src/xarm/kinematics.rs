//! Kinematics of the arm: six joints with the published parameters of an xArm 6.

use std::f64::consts::FRAC_PI_2;

use crate::placement::Placement;

/// Angles of the joints, rad.
pub(super) type Angles = [f64; 6];

/// A joint and the link before it.
struct Link {
    zero_rad: f64,
    along_mm: f64,
    twist_rad: f64,
    across_mm: f64,
}

const fn link(zero_rad: f64, along_mm: f64, twist_rad: f64, across_mm: f64) -> Link {
    Link {
        zero_rad,
        along_mm,
        twist_rad,
        across_mm,
    }
}

const LINKS: [Link; 6] = [
    link(0.0, 267.0, 0.0, 0.0),
    link(-1.384_917_9, 0.0, -FRAC_PI_2, 0.0),
    link(1.384_917_9, 0.0, 0.0, 289.488_66),
    link(0.0, 342.5, -FRAC_PI_2, 77.5),
    link(0.0, 0.0, FRAC_PI_2, 0.0),
    link(0.0, 97.0, -FRAC_PI_2, 76.0),
];
/// Approximate angles of the joints, rad, with the tool above the gel and pointing down.
pub(super) const ABOVE: Angles = [0.0, -0.46, -0.36, 0.0, 0.82, 0.0];

/// Placement of the flange for the joint angles `angles`.
pub(super) fn flange(angles: Angles) -> Placement {
    let base = Placement {
        at_mm: [0.0; 3],
        rows: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    };
    let joints = LINKS.iter().zip(angles);
    joints.fold(base, |before, (link, angle)| {
        before.then(&link.turned(angle))
    })
}

impl Link {
    fn turned(&self, angle: f64) -> Placement {
        let (sin, cos) = (angle + self.zero_rad).sin_cos();
        let (st, ct) = self.twist_rad.sin_cos();
        Placement {
            at_mm: [self.across_mm, -self.along_mm * st, self.along_mm * ct],
            rows: [
                [cos, -sin, 0.0],
                [sin * ct, cos * ct, -st],
                [sin * st, cos * st, ct],
            ],
        }
    }
}

/// Angles near `from` that bring the flange to `target`; `None` if none are found.
pub(super) fn angles_at(target: &Placement, from: Angles) -> Option<Angles> {
    const STEPS: u32 = 20;
    /// Greatest change of an angle in one step of the search, rad. Derivatives use the angle difference `SMALL`, rad.
    const STEP_MAX: f64 = 0.3;
    const SMALL: f64 = 1e-6;
    /// Damping of the search for angles. It keeps steps short where the arm cannot move in some direction.
    const DAMPING: f64 = 1e-6;
    let mut angles = from;
    for _ in 0..STEPS {
        let error = left(angles, target);
        if error.iter().all(|part| part.abs() < 1e-9) {
            return Some(angles);
        }
        let slopes: [[f64; 6]; 6] = std::array::from_fn(|joint| {
            let mut turned = angles;
            turned[joint] += SMALL;
            let turned = left(turned, target);
            std::array::from_fn(|part| (error[part] - turned[part]) / SMALL)
        });
        let product = |one: &[f64; 6], other: &[f64; 6]| -> f64 {
            one.iter().zip(other).map(|(one, other)| one * other).sum()
        };
        let equations = std::array::from_fn(|row| {
            std::array::from_fn(|column| match slopes.get(column) {
                Some(slope) if row == column => product(slope, slope) + DAMPING,
                Some(slope) => product(&slopes[row], slope),
                None => product(&slopes[row], &error),
            })
        });
        let steps = solved(equations);
        angles =
            std::array::from_fn(|joint| angles[joint] + steps[joint].clamp(-STEP_MAX, STEP_MAX));
    }
    None
}

/// Remaining displacement and rotation vector from the flange to `target`, in decimetres and rad.
fn left(angles: Angles, target: &Placement) -> [f64; 6] {
    let [x, y, z, rx, ry, rz] = flange(angles).apart(target);
    [x / 100.0, y / 100.0, z / 100.0, rx, ry, rz]
}

/// Solution of six equations with a positive definite matrix. The last entry of each equation is its right side.
fn solved(equations: [[f64; 7]; 6]) -> [f64; 6] {
    let solved = (0..6).fold(equations, |rows: [[f64; 7]; 6], at| {
        let pivot = rows[at].map(|entry| entry / rows[at][at]);
        std::array::from_fn(|row| match row == at {
            true => pivot,
            false => {
                std::array::from_fn(|column| rows[row][column] - rows[row][at] * pivot[column])
            }
        })
    });
    solved.map(|[.., last]| last)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_flange_of_an_arm_with_all_joints_at_zero_is_where_the_maker_says() {
        let [x, y, z, ..] = flange([0.0; 6]).pose();
        for (found, expected) in [(x, 207.0), (y, 0.0), (z, 112.0)] {
            assert!((found - expected).abs() < 0.01, "{found} {expected}");
        }
    }

    #[test]
    fn angles_of_a_pose_lead_back_to_it() {
        for pose in [
            [300.0, 0.0, 271.3, std::f32::consts::PI, 0.0, 0.0],
            [340.0, -50.0, 230.0, 3.0, 0.1, 0.9],
            [250.0, 55.0, 340.0, -3.1, 0.0, -0.8],
        ] {
            let target = Placement::of_pose(pose);
            let angles = angles_at(&target, ABOVE).expect("it is within reach");
            let apart = flange(angles).apart(&target);
            assert!(apart.iter().all(|part| part.abs() < 1e-6), "{apart:?}");
        }
        let far = Placement::of_pose([3_000.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        assert!(angles_at(&far, ABOVE).is_none());
    }
}
