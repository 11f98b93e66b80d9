//! Converts rotation matrices to quaternions.

use taceva_dataset::TaskLabel;

/// Quaternion x, y, z, w of `matrix`, which is given row by row. `w` is at least 0. `None` if the matrix is not a rotation.
///
/// The greatest of the four parts is computed first (Shepperd 1978), so that no division by a small number occurs.
pub(super) fn quaternion(matrix: [f64; 9]) -> Option<[f64; 4]> {
    let [a, b, c, d, e, f, g, h, i] = matrix;
    if !is_rotation([[a, b, c], [d, e, f], [g, h, i]]) {
        return None;
    }
    let parts = [
        1.0 + a - e - i,
        1.0 - a + e - i,
        1.0 - a - e + i,
        1.0 + a + e + i,
    ];
    let greatest = (0..4).max_by(|one, other| parts[*one].total_cmp(&parts[*other]))?;
    let numbers = match greatest {
        0 => [parts[0], d + b, g + c, h - f],
        1 => [d + b, parts[1], h + f, c - g],
        2 => [g + c, h + f, parts[2], d - b],
        _ => [h - f, c - g, d - b, parts[3]],
    };
    let squares = numbers.map(|number| number * number);
    let norm = squares.iter().sum::<f64>().sqrt();
    let signed = if numbers[3] < 0.0 { -norm } else { norm };
    Some(numbers.map(|number| number / signed))
}

/// True if the rows are perpendicular, of length 1 and right-handed.
fn is_rotation(rows: [[f64; 3]; 3]) -> bool {
    let dot = |one: [f64; 3], other: [f64; 3]| -> f64 {
        one.iter().zip(other).map(|(one, other)| one * other).sum()
    };
    let [one, two, three] = rows;
    let across = [
        one[1] * two[2] - one[2] * two[1],
        one[2] * two[0] - one[0] * two[2],
        one[0] * two[1] - one[1] * two[0],
    ];
    let ones = [dot(one, one), dot(two, two), dot(three, across)];
    let zeros = [dot(one, two), dot(one, three), dot(two, three)];
    let near =
        |number: f64, wanted: f64| (number - wanted).abs() <= 2.0 * TaskLabel::NORM_TOLERANCE;
    ones.into_iter().all(|number| near(number, 1.0))
        && zeros.into_iter().all(|number| near(number, 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(matrix: [f64; 9], expected: [f64; 4]) {
        let found = quaternion(matrix).expect("a rotation");
        let is_near = |(found, expected): (f64, f64)| (found - expected).abs() < 1e-12;
        assert!(found.into_iter().zip(expected).all(is_near), "{found:?}");
    }

    #[test]
    fn matrices_of_each_greatest_part_give_their_quaternion() {
        check(
            [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
            [0.0, 0.0, 0.0, 1.0],
        );
        // Half turns about x, y and z.
        check(
            [1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, -1.0],
            [1.0, 0.0, 0.0, 0.0],
        );
        check(
            [-1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, -1.0],
            [0.0, 1.0, 0.0, 0.0],
        );
        check(
            [-1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 1.0],
            [0.0, 0.0, 1.0, 0.0],
        );
        // A rotation about z with cos −0.28 and sin 0.96 has the quaternion z 0.8, w 0.6.
        check(
            [-0.28, -0.96, 0.0, 0.96, -0.28, 0.0, 0.0, 0.0, 1.0],
            [0.0, 0.0, 0.8, 0.6],
        );
    }

    #[test]
    fn reflections_and_stretched_matrices_are_no_rotations() {
        let mirror = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, -1.0];
        let stretched = [1.1, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
        let sheared = [1.0, 0.1, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
        for matrix in [mirror, stretched, sheared, [f64::NAN; 9]] {
            assert_eq!(quaternion(matrix), None, "{matrix:?}");
        }
    }
}
