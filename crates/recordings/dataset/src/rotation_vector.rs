//! Rotations as three numbers that a model can predict.

/// Rotation as its unit axis times its angle, degrees. The length is at most 180.
///
/// ```
/// use taceva_dataset::RotationVector;
///
/// let half = 0.5_f64.sqrt();
/// let quarter_turn = RotationVector::of_quaternion([0.0, 0.0, half, half]);
/// assert!((quarter_turn.degrees()[2] - 90.0).abs() < 1e-9);
/// let [.., w] = quarter_turn.quaternion();
/// assert!((w - half).abs() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotationVector {
    degrees: [f64; 3],
}

impl RotationVector {
    /// Rotation vector with the components `degrees` along x, y and z.
    pub fn new(degrees: [f64; 3]) -> RotationVector {
        RotationVector { degrees }
    }

    /// Rotation vector of the unit quaternion x, y, z, w.
    pub fn of_quaternion([x, y, z, w]: [f64; 4]) -> RotationVector {
        // A quaternion and its negative are the same rotation. The sign with the smaller angle is taken.
        let sign = if w < 0.0 { -1.0 } else { 1.0 };
        let vector = [x, y, z].map(|part| sign * part);
        let length = length(vector);
        let degrees_per_part = match length > 0.0 {
            true => 2.0 * length.atan2(sign * w).to_degrees() / length,
            false => 0.0,
        };
        RotationVector {
            degrees: vector.map(|part| degrees_per_part * part),
        }
    }

    /// Components along x, y and z, degrees.
    pub fn degrees(self) -> [f64; 3] {
        self.degrees
    }

    /// Unit quaternion x, y, z, w of the rotation.
    pub fn quaternion(self) -> [f64; 4] {
        let angle = length(self.degrees);
        let half = (0.5 * angle).to_radians();
        let per_degree = if angle > 0.0 { half.sin() / angle } else { 0.0 };
        let [x, y, z] = self.degrees.map(|part| per_degree * part);
        [x, y, z, half.cos()]
    }
}

fn length(vector: [f64; 3]) -> f64 {
    vector.iter().map(|part| part * part).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quaternions_come_back_up_to_their_sign() {
        for quaternion in [
            [0.0, 0.0, 0.0, 1.0],
            [0.5, -0.5, 0.5, 0.5],
            [0.0, 0.6, 0.0, -0.8],
            [1.0, 0.0, 0.0, 0.0],
            [1e-12, 0.0, 0.0, 1.0],
        ] {
            let found = RotationVector::of_quaternion(quaternion).quaternion();
            let product: f64 = found
                .iter()
                .zip(quaternion)
                .map(|(one, other)| one * other)
                .sum();
            assert!(
                (product.abs() - 1.0).abs() < 1e-12,
                "{quaternion:?}: {found:?}"
            );
        }
    }

    #[test]
    fn a_small_turn_keeps_its_size_and_a_great_one_is_at_most_half_a_turn() {
        let small = RotationVector::of_quaternion([0.0, 1e-9, 0.0, 1.0]).degrees();
        assert!(
            (small[1] / 2e-9_f64.to_degrees() - 1.0).abs() < 1e-9,
            "{small:?}"
        );
        // 270° about x is −90°.
        let half = 0.5_f64.sqrt();
        let great = RotationVector::of_quaternion([half, 0.0, 0.0, -half]).degrees();
        assert!((great[0] + 90.0).abs() < 1e-9, "{great:?}");
    }
}
