//! Conversion between poses and the numbers of the controller: metres, and a rotation vector whose length is the angle in rad.

use taceva_core::{Pose, SiPose};

/// Converts a position in m and a rotation vector in rad to a pose; `None` if a number is not finite.
pub(super) fn pose_of([x, y, z, rx, ry, rz]: [f64; 6]) -> Option<Pose> {
    let angle = (rx * rx + ry * ry + rz * rz).sqrt();
    // Limit of sin(angle / 2) / angle for a vanishing angle.
    let share = if angle > 0.0 {
        (angle / 2.0).sin() / angle
    } else {
        0.5
    };
    let si = SiPose {
        position_m: [x, y, z],
        quaternion: [(angle / 2.0).cos(), share * rx, share * ry, share * rz],
    };
    si.to_pose()
}

/// Converts a pose to a position in m and a rotation vector in rad.
pub(super) fn numbers_of(pose: Pose) -> [f64; 6] {
    let SiPose {
        position_m: [x, y, z],
        quaternion: [real, i, j, k],
    } = SiPose::from(pose);
    let length = (i * i + j * j + k * k).sqrt();
    let angle = 2.0 * length.atan2(real);
    let share = if length > 0.0 { angle / length } else { 2.0 };
    [x, y, z, share * i, share * j, share * k]
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use taceva_core::{Degree, Millimetre};

    use super::*;

    #[test]
    fn a_tool_that_points_down_is_half_a_turn_about_x() {
        let mut pose = Pose::default();
        pose.position.x = Millimetre(300.0);
        pose.rotation.x = Degree(180.0);
        let numbers = numbers_of(pose);
        for (found, expected) in numbers.into_iter().zip([0.3, 0.0, 0.0, PI, 0.0, 0.0]) {
            assert!((found - expected).abs() < 1e-9, "{numbers:?}");
        }
        assert_eq!(pose_of([0.3, 0.0, 0.0, PI, 0.0, 0.0]), Some(pose));
        let quarter = pose_of([0.0, 0.0, 0.0, 0.0, 0.0, FRAC_PI_2]).expect("numbers");
        assert!((quarter.rotation.z.0 - 90.0).abs() < 1e-9);
    }

    #[test]
    fn poses_survive_the_way_there_and_back() {
        for (x, y, z) in [(0.0, 0.0, 0.0), (10.0, -20.0, 30.0), (-179.0, 45.0, 1e-6)] {
            let mut pose = Pose::default();
            pose.rotation.x = Degree(x);
            pose.rotation.y = Degree(y);
            pose.rotation.z = Degree(z);
            let back = pose_of(numbers_of(pose)).expect("numbers");
            for (one, other) in [
                (back.rotation.x.0, x),
                (back.rotation.y.0, y),
                (back.rotation.z.0, z),
            ] {
                assert!((one - other).abs() < 1e-6, "{back:?}, {pose:?}");
            }
        }
    }

    #[test]
    fn what_is_no_number_is_no_pose() {
        for position in 0..6 {
            let mut numbers = [0.1; 6];
            numbers[position] = f64::NAN;
            assert_eq!(pose_of(numbers), None);
        }
    }
}
