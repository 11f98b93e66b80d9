//! Rotations as unit quaternions.

use super::error::PoseError;
use crate::vector::{cross, degrees, dot, length};

/// Greatest deviation of a norm, or of a scalar product of columns, from its value for a rotation.
const TOLERANCE: f64 = 1e-6;

/// Rotation by a quaternion x, y, z, w of norm 1 ± 1e-6. A quaternion and its negative are the same rotation.
///
/// ```
/// use taceva_tasks::pose::Rotation;
/// let half_turn = Rotation::of_quaternion(1, [0.0, 1.0, 0.0, 0.0])?;
/// assert_eq!(Rotation::IDENTITY.degrees_to(half_turn), 180.0);
/// # Ok::<(), taceva_tasks::pose::PoseError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotation {
    /// Vector part x, y, z.
    vector: [f64; 3],
    /// Scalar part w.
    scalar: f64,
}

impl Rotation {
    /// No rotation.
    pub const IDENTITY: Rotation = Rotation {
        vector: [0.0; 3],
        scalar: 1.0,
    };

    /// Rotation by the quaternion x, y, z, w of row `row`.
    ///
    /// # Errors
    /// [`PoseError::Norm`] unless the norm is 1 within 1e-6.
    pub fn of_quaternion(row: u64, [x, y, z, w]: [f64; 4]) -> Result<Rotation, PoseError> {
        let norm = (x * x + y * y + z * z + w * w).sqrt();
        let rotation = Rotation {
            vector: [x, y, z],
            scalar: w,
        };
        ((norm - 1.0).abs() <= TOLERANCE)
            .then_some(rotation)
            .ok_or(PoseError::Norm { row, norm })
    }

    /// Rotation of a 3×3 matrix, given by rows. `row` is the row of the file for errors.
    ///
    /// # Errors
    /// [`PoseError::NoRotation`] unless the columns are unit vectors at right angles within 1e-6;
    /// [`PoseError::Mirror`] for a determinant of −1.
    ///
    /// # Reference
    /// Shepperd, Quaternion from rotation matrix, Journal of Guidance and Control 1 (1978).
    pub fn of_matrix(row: u64, rows: [[f64; 3]; 3]) -> Result<Rotation, PoseError> {
        let column = |at: usize| rows.map(|row| row[at]);
        let columns = [column(0), column(1), column(2)];
        let mut deviation = 0.0_f64;
        for left in 0..3 {
            for right in left..3 {
                let expected = if left == right { 1.0 } else { 0.0 };
                let off = (dot(columns[left], columns[right]) - expected).abs();
                if off > deviation || off.is_nan() {
                    deviation = off;
                }
            }
        }
        let is_orthonormal = deviation <= TOLERANCE;
        if !is_orthonormal {
            return Err(PoseError::NoRotation { row, deviation });
        }
        if dot(cross(columns[0], columns[1]), columns[2]) < 0.0 {
            return Err(PoseError::Mirror { row });
        }
        Ok(Rotation::of_orthonormal(rows))
    }

    /// Rotation by a matrix whose columns are unit vectors at right angles.
    fn of_orthonormal([[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]]: [[f64; 3]; 3]) -> Rotation {
        // Four times the squares of x, y, z and w. The greatest gives the divisor without cancellation.
        let [x, y, z] = [xx - yy - zz, yy - xx - zz, zz - xx - yy].map(|square| 1.0 + square);
        let w = 1.0 + xx + yy + zz;
        let (xy_sum, xz_sum, yz_sum) = (xy + yx, xz + zx, yz + zy);
        let axis = [zy - yz, xz - zx, yx - xy];
        let greatest = x.max(y).max(z).max(w);
        let parts = if w >= greatest {
            [axis[0], axis[1], axis[2], w]
        } else if x >= greatest {
            [x, xy_sum, xz_sum, axis[0]]
        } else if y >= greatest {
            [xy_sum, y, yz_sum, axis[1]]
        } else {
            [xz_sum, yz_sum, z, axis[2]]
        };
        let divisor = 2.0 * greatest.sqrt();
        let [x, y, z, w] = parts.map(|part| part / divisor);
        Rotation {
            vector: [x, y, z],
            scalar: w,
        }
    }

    /// Quaternion x, y, z, w.
    #[must_use]
    pub fn quaternion(self) -> [f64; 4] {
        let [x, y, z] = self.vector;
        [x, y, z, self.scalar]
    }

    /// Angle of the rotation from this rotation to `other`, in degrees from 0 to 180.
    ///
    /// The angle is 2 atan2(‖v‖, |w|) of the quaternion self⁻¹ other, with vector v and scalar w. Norms cancel out.
    #[must_use]
    pub fn degrees_to(self, other: Rotation) -> f64 {
        let [[x1, y1, z1, w1], [x2, y2, z2, w2]] = [self.quaternion(), other.quaternion()];
        let scalar = w1 * w2 + x1 * x2 + y1 * y2 + z1 * z2;
        let vector = [
            w1 * x2 - x1 * w2 - y1 * z2 + z1 * y2,
            w1 * y2 + x1 * z2 - y1 * w2 - z1 * x2,
            w1 * z2 - x1 * y2 + y1 * x2 - z1 * w2,
        ];
        2.0 * degrees(length(vector), scalar.abs())
    }

    /// Yaw: the last angle of a rotation about x, then y, then z of fixed axes, in degrees from −180 to 180.
    #[must_use]
    pub fn yaw_degrees(self) -> f64 {
        let [x, y, z, w] = self.quaternion();
        degrees(2.0 * (w * z + x * y), w * w + x * x - y * y - z * z)
    }

    /// Rotates `point`.
    pub(super) fn turn(self, point: [f64; 3]) -> [f64; 3] {
        let twice = 2.0 / (dot(self.vector, self.vector) + self.scalar * self.scalar);
        let across = cross(self.vector, point).map(|part| part * twice);
        let turned = cross(self.vector, across);
        std::array::from_fn(|axis| point[axis] + self.scalar * across[axis] + turned[axis])
    }
}
