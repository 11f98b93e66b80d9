//! Position and rotation of a tool, and operations on them.

use taceva_core::single;

/// Position and rotation of one frame relative to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Placement {
    pub(crate) at_mm: [f64; 3],
    /// Rows of the rotation matrix.
    pub(crate) rows: [[f64; 3]; 3],
}

impl Placement {
    /// Creates a frame from x, y and z in mm, and roll, pitch and yaw in rad about the fixed x, y and z axes.
    pub(crate) fn of_pose(pose: [f32; 6]) -> Placement {
        let [x, y, z, roll, pitch, yaw] = pose.map(f64::from);
        let [(sr, cr), (sp, cp), (sy, cy)] = [roll, pitch, yaw].map(f64::sin_cos);
        Placement {
            at_mm: [x, y, z],
            rows: [
                [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
                [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
                [-sp, cp * sr, cp * cr],
            ],
        }
    }

    /// Creates a frame from x, y and z in mm, and a rotation vector in rad.
    pub(crate) fn of_rotation_vector(pose: [f32; 6]) -> Placement {
        let [x, y, z, rotation @ ..] = pose.map(f64::from);
        let angle = length(rotation);
        let axis = rotation.map(|part| if angle > 0.0 { part / angle } else { 0.0 });
        let (sin, cos) = angle.sin_cos();
        Placement {
            at_mm: [x, y, z],
            rows: square(|row, column| {
                let same = if row == column { cos } else { 0.0 };
                same + (1.0 - cos) * axis[row] * axis[column] + sin * crossing(axis, row, column)
            }),
        }
    }

    /// Position in mm, with roll, pitch and yaw in rad.
    pub(crate) fn pose(&self) -> [f32; 6] {
        let [[r00, ..], [r10, r11, r12], [r20, r21, r22]] = self.rows;
        let level = r00.hypot(r10);
        let pitch = (-r20).atan2(level);
        // With the tool upright, roll and yaw are one rotation.
        let [roll, yaw] = if level > 1e-9 {
            [r21.atan2(r22), r10.atan2(r00)]
        } else {
            [(-r12).atan2(r11), 0.0]
        };
        let [x, y, z] = self.at_mm;
        [x, y, z, roll, pitch, yaw].map(single)
    }

    /// Position in mm, with a rotation vector in rad.
    pub(crate) fn rotation_vector(&self) -> [f32; 6] {
        let skew = self.skew();
        let sin = length(skew);
        let cos = (self.rows[0][0] + self.rows[1][1] + self.rows[2][2] - 1.0) / 2.0;
        let angle = sin.atan2(cos);
        let axis = if cos < 0.0 {
            self.axis_of_a_wide_turn(cos)
        } else {
            skew.map(|part| if sin > 0.0 { part / sin } else { 0.0 })
        };
        let [x, y, z] = self.at_mm;
        let [rx, ry, rz] = axis.map(|part| part * angle);
        [x, y, z, rx, ry, rz].map(single)
    }

    /// Unit axis of a rotation by more than 90°. It follows from the symmetric part of the rotation matrix, which is accurate up to 180°.
    fn axis_of_a_wide_turn(&self, cos: f64) -> [f64; 3] {
        let rows = &self.rows;
        let products = square(|row, column| {
            let same = if row == column { cos } else { 0.0 };
            ((rows[row][column] + rows[column][row]) / 2.0 - same) / (1.0 - cos)
        });
        let longest = (0..3).fold(0, |most, at| {
            match products[at][at] > products[most][most] {
                true => at,
                false => most,
            }
        });
        let axis = products[longest].map(|part| part / products[longest][longest].sqrt());
        let skew = self.skew();
        let along: f64 = axis.iter().zip(skew).map(|(one, other)| one * other).sum();
        axis.map(|part| if along < 0.0 { -part } else { part })
    }

    /// Axis of the rotation, multiplied by the sine of its angle.
    fn skew(&self) -> [f64; 3] {
        let [[_, r01, r02], [r10, _, r12], [r20, r21, _]] = self.rows;
        [r21 - r12, r02 - r20, r10 - r01].map(|part| part / 2.0)
    }

    /// The frame `inner`, which is given in this frame, expressed in the base of this frame.
    pub(crate) fn then(&self, inner: &Placement) -> Placement {
        let moved = self.turned(inner.at_mm);
        Placement {
            at_mm: std::array::from_fn(|axis| self.at_mm[axis] + moved[axis]),
            rows: self.times(inner),
        }
    }

    /// This frame, moved and rotated by `by`. The motion is along and about the axes of the base.
    pub(crate) fn moved_by(&self, by: &Placement) -> Placement {
        Placement {
            at_mm: std::array::from_fn(|axis| self.at_mm[axis] + by.at_mm[axis]),
            rows: by.times(self),
        }
    }

    /// Difference of `other` from this frame: the displacement, mm, and the rotation vector, rad. Valid for small rotations.
    pub(crate) fn apart(&self, other: &Placement) -> [f64; 6] {
        let back = Placement {
            at_mm: [0.0; 3],
            rows: square(|row, column| self.rows[column][row]),
        };
        let turn = Placement {
            at_mm: [0.0; 3],
            rows: other.times(&back),
        };
        let [rx, ry, rz] = turn.skew();
        let [x, y, z] = std::array::from_fn(|axis| other.at_mm[axis] - self.at_mm[axis]);
        [x, y, z, rx, ry, rz]
    }

    fn times(&self, inner: &Placement) -> [[f64; 3]; 3] {
        square(|row, column| {
            let parts = (0..3).map(|at| self.rows[row][at] * inner.rows[at][column]);
            parts.sum()
        })
    }

    fn turned(&self, vector: [f64; 3]) -> [f64; 3] {
        self.rows
            .map(|row| row.iter().zip(vector).map(|(one, other)| one * other).sum())
    }
}

fn square(entry: impl Fn(usize, usize) -> f64) -> [[f64; 3]; 3] {
    std::array::from_fn(|row| std::array::from_fn(|column| entry(row, column)))
}

fn length([x, y, z]: [f64; 3]) -> f64 {
    x.hypot(y).hypot(z)
}

/// Entry of the matrix that multiplies a vector by `axis` in a cross product.
fn crossing(axis: [f64; 3], row: usize, column: usize) -> f64 {
    match (3 + column - row) % 3 {
        1 => -axis[3 - row - column],
        2 => axis[3 - row - column],
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use std::f32::consts::PI;

    use super::*;

    #[track_caller]
    fn assert_near(found: [f32; 6], expected: [f32; 6]) {
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-4, "{found} {expected}");
        }
    }

    #[test]
    fn a_pose_is_the_same_by_angles_and_by_a_rotation_vector() {
        for pose in [
            [300.0, -20.0, 271.3, 0.0, 0.0, 0.0],
            [300.0, -20.0, 271.3, 3.0, 0.1, -0.2],
            [1.0, 2.0, 3.0, 0.3, -1.2, 2.5],
            [1.0, 2.0, 3.0, -1.0, 0.4, 1.0],
        ] {
            let placement = Placement::of_pose(pose);
            assert_near(placement.pose(), pose);
            let again = Placement::of_rotation_vector(placement.rotation_vector());
            assert_near(again.pose(), pose);
        }
    }

    #[test]
    fn a_tool_that_points_down_is_half_a_turn_about_x() {
        let down = Placement::of_pose([300.0, 0.0, 271.3, PI, 0.0, 0.0]);
        let [.., rx, ry, rz] = down.rotation_vector();
        assert!((rx.abs() - PI).abs() < 1e-5, "{rx}");
        assert!(ry.abs() < 1e-5 && rz.abs() < 1e-5, "{ry} {rz}");
    }

    #[test]
    fn a_motion_along_the_tool_goes_where_the_tool_points() {
        let down = Placement::of_pose([300.0, 0.0, 271.3, PI, 0.0, 0.0]);
        let step = Placement::of_pose([0.0, 2.0, 5.0, 0.0, 0.0, 0.0]);
        let [x, y, z, ..] = down.then(&step).pose();
        assert_near(
            [x, y, z, 0.0, 0.0, 0.0],
            [300.0, -2.0, 266.3, 0.0, 0.0, 0.0],
        );
        let [x, y, z, ..] = down.moved_by(&step).pose();
        assert_near([x, y, z, 0.0, 0.0, 0.0], [300.0, 2.0, 276.3, 0.0, 0.0, 0.0]);
    }
}
