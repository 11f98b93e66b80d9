//! Orientation of a rigid body in space.

use crate::quantity::Degree;

/// Orientation of a rigid body, stored as a unit quaternion. A quaternion and its negative represent the same orientation.
///
/// # Units
/// Rotation vectors are in radians: the direction is the axis, and the length is the angle.
///
/// ```
/// use taceva_core::Orientation;
/// let half_turn = Orientation::of_vector([2.9024, -1.2023, 0.0]);
/// let reported_otherwise = Orientation::of_vector([-2.9024, 1.2023, 0.0]);
/// assert!(half_turn.angle_to(reported_otherwise).0 < 0.01);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orientation {
    x: f64,
    y: f64,
    z: f64,
    w: f64,
}

/// Greatest accepted deviation of a quaternion's norm from 1. The tolerance allows for quaternions with few decimals in files.
const NORM_TOLERANCE: f64 = 0.01;

impl Orientation {
    /// Orientation from a rotation vector, whose direction is the axis and whose length is the angle in radians.
    pub fn of_vector(vector: [f64; 3]) -> Orientation {
        let angle = norm(&vector);
        let factor = match angle > 0.0 {
            true => (angle / 2.0).sin() / angle,
            false => 0.5,
        };
        let [x, y, z] = vector.map(|part| part * factor);
        let w = (angle / 2.0).cos();
        Orientation { x, y, z, w }
    }

    /// Orientation from the quaternion `[x, y, z, w]`; `None` if its norm differs from 1 by more than 0.01.
    pub fn of_quaternion(quaternion: [f64; 4]) -> Option<Orientation> {
        let length = norm(&quaternion);
        let [x, y, z, w] = quaternion.map(|part| part / length);
        ((length - 1.0).abs() <= NORM_TOLERANCE).then_some(Orientation { x, y, z, w })
    }

    /// Unit quaternion `[x, y, z, w]`.
    pub fn quaternion(self) -> [f64; 4] {
        [self.x, self.y, self.z, self.w]
    }

    /// Rotation vector in radians. Its length, the angle, is at most π.
    pub fn vector(self) -> [f64; 3] {
        let sign = if self.w < 0.0 { -1.0 } else { 1.0 };
        let axis = [self.x, self.y, self.z];
        let sine = norm(&axis);
        let factor = match sine > 0.0 {
            true => 2.0 * sine.atan2(sign * self.w) / sine,
            false => 2.0,
        };
        axis.map(|part| part * sign * factor)
    }

    /// Angle of the rotation from this orientation to `other`, from 0 to 180 degrees.
    pub fn angle_to(self, other: Orientation) -> Degree {
        let other = other.beside(self).quaternion();
        let own = self.quaternion();
        let apart: Vec<f64> = own.iter().zip(other).map(|(a, b)| a - b).collect();
        let along: Vec<f64> = own.iter().zip(other).map(|(a, b)| a + b).collect();
        Degree((4.0 * norm(&apart).atan2(norm(&along))).to_degrees())
    }

    /// Interpolates along the shortest rotation: this orientation for `share` 0, `other` for `share` 1.
    pub fn toward(self, other: Orientation, share: f64) -> Orientation {
        let other = other.beside(self);
        let half = self.angle_to(other).0.to_radians() / 2.0;
        let [own, others] = match half.sin() > 1e-9 {
            true => [1.0 - share, share].map(|share| (share * half).sin() / half.sin()),
            false => [1.0 - share, share],
        };
        let pairs = self.quaternion().into_iter().zip(other.quaternion());
        let mut parts = pairs.map(|(a, b)| own * a + others * b);
        let mut next = || parts.next().unwrap_or_default();
        let mixed = [next(), next(), next(), next()];
        let length = norm(&mixed);
        let [x, y, z, w] = mixed.map(|part| part / length);
        Orientation { x, y, z, w }
    }

    /// Converts a vector from world coordinates to coordinates of the body.
    pub fn into_body(self, [a, b, c]: [f64; 3]) -> [f64; 3] {
        let Orientation { x, y, z, w } = self;
        [
            (1.0 - 2.0 * (y * y + z * z)) * a
                + 2.0 * (x * y + z * w) * b
                + 2.0 * (x * z - y * w) * c,
            2.0 * (x * y - z * w) * a
                + (1.0 - 2.0 * (x * x + z * z)) * b
                + 2.0 * (y * z + x * w) * c,
            2.0 * (x * z + y * w) * a
                + 2.0 * (y * z - x * w) * b
                + (1.0 - 2.0 * (x * x + y * y)) * c,
        ]
    }

    /// Returns this orientation, with its quaternion negated if that brings the quaternion closer to the quaternion of `other`.
    fn beside(self, other: Orientation) -> Orientation {
        let pairs = self.quaternion().into_iter().zip(other.quaternion());
        let product: f64 = pairs.map(|(a, b)| a * b).sum();
        match product < 0.0 {
            true => Orientation {
                x: -self.x,
                y: -self.y,
                z: -self.z,
                w: -self.w,
            },
            false => self,
        }
    }
}

fn norm(parts: &[f64]) -> f64 {
    parts.iter().map(|part| part * part).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_near(found: &[f64], expected: &[f64]) {
        let pairs = found.iter().zip(expected);
        let distance = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(distance < 1e-12, "{found:?} for {expected:?}");
    }

    #[test]
    fn vectors_and_quaternions_go_there_and_back() {
        for vector in [
            [0.0; 3],
            [0.1, -0.2, 0.3],
            [3.0, 0.5, -0.5],
            [1e-12, 0.0, 0.0],
        ] {
            let orientation = Orientation::of_vector(vector);
            assert_near(&orientation.vector(), &vector);
            let again = Orientation::of_quaternion(orientation.quaternion().map(|part| -part));
            assert_near(&again.expect("a unit quaternion").vector(), &vector);
        }
        assert_eq!(Orientation::of_quaternion([0.0; 4]), None);
        assert_eq!(Orientation::of_quaternion([0.0, 0.0, 0.0, 2.0]), None);
    }

    #[test]
    fn the_way_between_is_the_shortest_and_the_angle_is_that_of_the_turn() {
        let quarter = std::f64::consts::FRAC_PI_2;
        let start = Orientation::of_vector([0.0, 0.0, 0.0]);
        let end = Orientation::of_vector([0.0, 0.0, quarter]);
        assert_near(
            &start.toward(end, 1.0 / 3.0).vector(),
            &[0.0, 0.0, quarter / 3.0],
        );
        assert_near(&[start.angle_to(end).0], &[90.0]);
        // The angles 170 and -170 degrees differ by 20 degrees, through half a turn.
        let [one, other] =
            [170.0_f64, -170.0].map(|angle| Orientation::of_vector([0.0, angle.to_radians(), 0.0]));
        assert_near(&[one.angle_to(other).0], &[20.0]);
        let middle = one.toward(other, 0.25).vector()[1].to_degrees();
        assert!((middle - 175.0).abs() < 1e-9, "{middle}");
    }

    #[test]
    fn the_weight_of_a_tool_that_is_turned_lies_along_another_of_its_axes() {
        let quarter = std::f64::consts::FRAC_PI_2;
        let turned = Orientation::of_vector([quarter, 0.0, 0.0]);
        // Quarter turn about x: the tool's z axis points along -y, its y axis up.
        assert_near(&turned.into_body([0.0, 0.0, -1.0]), &[0.0, -1.0, 0.0]);
        let about_z = Orientation::of_vector([0.0, 0.0, quarter]);
        assert_near(&about_z.into_body([1.0, 0.0, 0.0]), &[0.0, -1.0, 0.0]);
    }
}
