//! Rigid motion that minimises the squared distances between the paired points of two clouds.

use crate::exact::number_key::ranked;

/// A point in space, mm.
pub(crate) type Point = [f64; 3];

/// Rigid motion: a rotation, then a translation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Motion {
    rotation: [[f64; 3]; 3],
    shift: [f64; 3],
}

impl Motion {
    /// Identity motion.
    pub(crate) const NONE: Motion = Motion {
        rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        shift: [0.0; 3],
    };

    /// Returns `point` after the motion.
    pub(crate) fn apply(&self, point: Point) -> Point {
        let turned = turned(&self.rotation, point);
        std::array::from_fn(|axis| turned[axis] + self.shift[axis])
    }

    /// Motion that moves the points `from` nearest to the points `onto`, paired by index: it minimises the sum of squared distances.
    ///
    /// `None` if the points do not determine the rotation: fewer than three points, or all points on one line.
    ///
    /// # Shapes
    /// `from` and `onto` have equal length.
    /// # Reference
    /// The problem is Kabsch's (1976). The solution is the unit quaternion of Horn, Closed-form solution of absolute orientation using unit
    /// quaternions (1987), which excludes reflections.
    pub(crate) fn between(from: &[Point], onto: &[Point]) -> Option<Motion> {
        let (from_centre, onto_centre) = (centre(from)?, centre(onto)?);
        let mut products = [[0.0; 3]; 3];
        for (from, onto) in from.iter().zip(onto) {
            let (from, onto) = (minus(*from, from_centre), minus(*onto, onto_centre));
            for (row, from) in products.iter_mut().zip(from) {
                for (product, onto) in row.iter_mut().zip(onto) {
                    *product += from * onto;
                }
            }
        }
        let rotation = rotation_of(leading_vector(quaternion_form(&products))?);
        let shift = minus(onto_centre, turned(&rotation, from_centre));
        Some(Motion { rotation, shift })
    }
}

/// Symmetric matrix of Horn, whose leading eigenvector is the quaternion of the rotation. `products[a][b]` is the sum over the pairs of axis a of
/// the moved point times axis b of its partner.
fn quaternion_form(products: &[[f64; 3]; 3]) -> [[f64; 4]; 4] {
    let [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = *products;
    [
        [xx + yy + zz, yz - zy, zx - xz, xy - yx],
        [yz - zy, xx - yy - zz, xy + yx, zx + xz],
        [zx - xz, xy + yx, yy - xx - zz, yz + zy],
        [xy - yx, zx + xz, yz + zy, zz - xx - yy],
    ]
}

/// Eigenvector of `matrix` for its greatest eigenvalue, by Jacobi rotations. `None` if the second eigenvalue is nearly as great.
fn leading_vector(mut matrix: [[f64; 4]; 4]) -> Option<[f64; 4]> {
    /// Number of sweeps of Jacobi rotations over all pairs of rows. Convergence is quadratic, so about six sweeps are enough.
    const SWEEPS: usize = 20;
    /// Least relative gap between the two greatest eigenvalues. For points on one line the gap is only rounding error, so the rotation is
    /// undetermined.
    const OPEN: f64 = 1e-12;
    let mut vectors = [[0.0; 4]; 4];
    for (place, vector) in vectors.iter_mut().enumerate() {
        vector[place] = 1.0;
    }
    for _ in 0..SWEEPS {
        for low in 0..4 {
            for high in low + 1..4 {
                clear(&mut matrix, &mut vectors, low, high);
            }
        }
    }
    let order = ranked(4, &|left, right| {
        matrix[right][right].total_cmp(&matrix[left][left])
    });
    let [first, second] = [order[0], order[1]];
    let apart = matrix[first][first] - matrix[second][second];
    let determined = apart > OPEN * matrix[first][first].abs();
    determined.then(|| vectors.map(|row| row[first]))
}

/// Applies the Jacobi rotation that makes the entry of `matrix` at (`low`, `high`) zero.
fn clear(matrix: &mut [[f64; 4]; 4], vectors: &mut [[f64; 4]; 4], low: usize, high: usize) {
    let entry = matrix[low][high];
    if entry.abs() <= f64::MIN_POSITIVE {
        return;
    }
    let theta = (matrix[high][high] - matrix[low][low]) / (2.0 * entry);
    let tangent = 1.0_f64.copysign(theta) / (theta.abs() + (theta * theta + 1.0).sqrt());
    let cosine = 1.0 / (tangent * tangent + 1.0).sqrt();
    let sine = tangent * cosine;
    let mix = |row: &mut [f64; 4]| {
        let (left, right) = (row[low], row[high]);
        row[low] = cosine * left - sine * right;
        row[high] = sine * left + cosine * right;
    };
    matrix.iter_mut().for_each(mix);
    let [upper, lower] = [matrix[low], matrix[high]];
    for (column, (upper, lower)) in upper.into_iter().zip(lower).enumerate() {
        matrix[low][column] = cosine * upper - sine * lower;
        matrix[high][column] = sine * upper + cosine * lower;
    }
    vectors.iter_mut().for_each(mix);
}

/// Rotation matrix of a quaternion, which is normalised first.
fn rotation_of([w, x, y, z]: [f64; 4]) -> [[f64; 3]; 3] {
    let twice = 2.0 / (w * w + x * x + y * y + z * z);
    let product = |left: f64, right: f64| twice * left * right;
    [
        [
            1.0 - product(y, y) - product(z, z),
            product(x, y) - product(w, z),
            product(x, z) + product(w, y),
        ],
        [
            product(x, y) + product(w, z),
            1.0 - product(x, x) - product(z, z),
            product(y, z) - product(w, x),
        ],
        [
            product(x, z) - product(w, y),
            product(y, z) + product(w, x),
            1.0 - product(x, x) - product(y, y),
        ],
    ]
}

fn turned(rotation: &[[f64; 3]; 3], point: Point) -> Point {
    rotation.map(|row| row[0] * point[0] + row[1] * point[1] + row[2] * point[2])
}

fn minus(left: Point, right: Point) -> Point {
    std::array::from_fn(|axis| left[axis] - right[axis])
}

/// Mean of the points; `None` for fewer than three.
fn centre(points: &[Point]) -> Option<Point> {
    let count = u32::try_from(points.len())
        .ok()
        .filter(|count| *count >= 3)?;
    let sum = |axis: usize| points.iter().map(|point| point[axis]).sum::<f64>();
    Some(std::array::from_fn(|axis| sum(axis) / f64::from(count)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn surface() -> Vec<Point> {
        let place = |at: u32| f64::from(at % 7) - 3.0 + 0.1 * f64::from(at % 3);
        let cloud = (0..42).map(|at| [place(at), place(at / 7 + 2), 0.05 * f64::from(at % 5)]);
        cloud.collect()
    }

    fn greatest_distance(left: &[Point], right: &[Point]) -> f64 {
        let pairs = left.iter().zip(right);
        let apart = pairs.map(|(left, right)| {
            let [x, y, z] = minus(*left, *right);
            (x * x + y * y + z * z).sqrt()
        });
        apart.fold(0.0, f64::max)
    }

    #[test]
    fn a_cloud_that_was_turned_and_shifted_is_brought_back() {
        for quaternion in [
            [1.0, 0.1, -0.2, 0.3],
            [0.2, 1.0, 0.0, 0.0],
            [0.0, 0.0, 0.0, 1.0],
            [1.0, 1.0, 1.0, 1.0],
        ] {
            let away = Motion {
                rotation: rotation_of(quaternion),
                shift: [12.0, -7.5, 0.25],
            };
            let cloud = surface();
            let moved: Vec<Point> = cloud.iter().map(|&point| away.apply(point)).collect();
            let back = Motion::between(&moved, &cloud).expect("a surface");
            let again: Vec<Point> = moved.iter().map(|&point| back.apply(point)).collect();
            // A few roundings of coordinates near 20.
            assert!(greatest_distance(&again, &cloud) < 1e-13, "{quaternion:?}");
        }
    }

    #[test]
    fn a_mirrored_cloud_is_turned_and_never_mirrored() {
        let cloud = surface();
        let mirrored: Vec<Point> = cloud.iter().map(|&[x, y, z]| [x, y, -z]).collect();
        let motion = Motion::between(&mirrored, &cloud).expect("a surface");
        let [x, y, z] = motion.rotation;
        let determinant = x[0] * (y[1] * z[2] - y[2] * z[1]) - x[1] * (y[0] * z[2] - y[2] * z[0])
            + x[2] * (y[0] * z[1] - y[1] * z[0]);
        assert!((determinant - 1.0).abs() < 1e-14);
    }

    #[test]
    fn points_on_one_line_leave_the_turn_open() {
        let line: Vec<Point> = (0..9)
            .map(|at| [f64::from(at), 0.3 * f64::from(at), 1.0])
            .collect();
        assert_eq!(Motion::between(&line, &line), None);
        assert_eq!(Motion::between(&[[1.0; 3]; 5], &[[2.0; 3]; 5]), None);
        assert_eq!(Motion::between(&surface()[..2], &surface()[..2]), None);
    }
}
