//! Exact test on which side of a line a point is.

use std::cmp::Ordering;

use crate::exact::ExactSum;

/// A point in the plane with finite coordinates.
pub(crate) type Place = [f64; 2];

/// Direction of the turn at `middle` from `start` to `end`: `Greater` to the left, `Less` to the right, `Equal` on one line.
///
/// For points a, b and c, the direction is the sign of (bx − ax)(cy − ay) − (by − ay)(cx − ax). Rounded arithmetic determines the sign in nearly
/// every case. Otherwise the six products of the expanded determinant are summed exactly.
///
/// # Reference
/// Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates (1997), the bound A of `ORIENT2D`.
pub(crate) fn turn(start: Place, middle: Place, end: Place) -> Ordering {
    /// Bound on the rounding error of the determinant, relative to the size of its products: (3 + 16 ε) ε with ε = 2⁻⁵³.
    const BOUND: f64 = (3.0 + 16.0 * EPSILON) * EPSILON;
    const EPSILON: f64 = f64::EPSILON / 2.0;
    /// Least total size of the products for which underflow cannot change the sign. The error bound ignores underflow.
    const LEAST: f64 = 1e-290;
    let left = (middle[0] - start[0]) * (end[1] - start[1]);
    let right = (middle[1] - start[1]) * (end[0] - start[0]);
    let determinant = left - right;
    let size = left.abs() + right.abs();
    if size > LEAST && size < f64::INFINITY && determinant.abs() > BOUND * size {
        return sign_of(determinant);
    }
    exact_turn(start, middle, end)
}

/// Sign of twice the signed area of the triangle `start`, `middle`, `end`, computed exactly.
fn exact_turn(start: Place, middle: Place, end: Place) -> Ordering {
    let mut determinant = ExactSum::default();
    for (from, to) in [(start, middle), (middle, end), (end, start)] {
        determinant.add_product(from[0], to[1]);
        determinant.add_product(-from[1], to[0]);
    }
    sign(&determinant)
}

/// Twice the signed area of the polygon through `corners`, exact; positive for anticlockwise order.
pub(crate) fn doubled_area(corners: &[Place]) -> ExactSum {
    let mut area = ExactSum::default();
    let next = corners.iter().cycle().skip(1);
    for (from, to) in corners.iter().zip(next) {
        area.add_product(from[0], to[1]);
        area.add_product(-from[1], to[0]);
    }
    area
}

/// Sign of `sum`: `Less` for negative, `Equal` for zero, `Greater` for positive.
pub(crate) fn sign(sum: &ExactSum) -> Ordering {
    let form = sum.to_canonical();
    match (form.digits().is_empty(), form.is_negative()) {
        (true, _) => Ordering::Equal,
        (false, true) => Ordering::Less,
        (false, false) => Ordering::Greater,
    }
}

fn sign_of(value: f64) -> Ordering {
    value.total_cmp(&0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_on_one_line_turn_nowhere_though_rounding_says_otherwise() {
        // Known case in which rounding fails: neighbours of 0.5 along the diagonal, seen from 12 and 24.
        let far = [24.0, 24.0];
        for steps in 0..64_u32 {
            let near = 0.5 + f64::from(steps) * f64::EPSILON;
            assert_eq!(turn([near, near], [12.0, 12.0], far), Ordering::Equal);
            let above = [near, near + f64::EPSILON];
            assert_eq!(turn(above, [12.0, 12.0], far), Ordering::Greater);
            let below = [near + f64::EPSILON, near];
            assert_eq!(turn(below, [12.0, 12.0], far), Ordering::Less);
        }
    }

    #[test]
    fn sizes_at_which_products_over_or_underflow_are_decided_too() {
        for scale in [f64::from_bits(1), 2.0_f64.powi(-600), 2.0_f64.powi(1020)] {
            let corner = [scale, scale];
            assert_eq!(turn([0.0, 0.0], [scale, 0.0], corner), Ordering::Greater);
            assert_eq!(turn([0.0, 0.0], [0.0, scale], corner), Ordering::Less);
            assert_eq!(turn([0.0, 0.0], [-0.0, 0.0], corner), Ordering::Equal);
        }
    }

    #[test]
    fn the_area_of_a_square_is_its_side_squared_and_turns_with_it() {
        let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
        let backwards: Vec<Place> = square.into_iter().rev().collect();
        assert_eq!(doubled_area(&square).to_f64().to_bits(), 8.0_f64.to_bits());
        assert_eq!(sign(&doubled_area(&backwards)), Ordering::Less);
    }
}
