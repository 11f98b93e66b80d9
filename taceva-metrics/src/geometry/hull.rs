//! Mergeable convex hulls: the hull of two hulls is the hull of all their points.

use std::cmp::Ordering;

use super::orientation::{Place, doubled_area, turn};
use crate::pair::is_valid;

/// Corners of the convex hull of points in the plane.
///
/// The corners run anticlockwise from the leftmost corner, and from the lowest of several leftmost corners. No corner is on the line between two
/// others, so equal sets of points have equal hulls. A hull is flat if all points are on one line: it then has at most two corners.
///
/// # Laws
/// Merging is associative, commutative and idempotent; the empty hull changes nothing.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Hull {
    corners: Vec<Place>,
}

impl Hull {
    /// Convex hull of `points`, whose coordinates must be finite.
    pub(crate) fn of(points: impl IntoIterator<Item = Place>) -> Hull {
        // Zeros get one sign, so that equal sets have equal hulls.
        let plain = |[x, y]: Place| [x + 0.0, y + 0.0];
        let mut points: Vec<Place> = points.into_iter().map(plain).collect();
        points.sort_unstable_by(compare);
        points.dedup_by(|one, other| compare(one, other) == Ordering::Equal);
        if points.len() < 3 {
            return Hull { corners: points };
        }
        let mut corners = chain(points.iter().copied());
        let upper = chain(points.iter().rev().copied());
        corners.pop();
        corners.extend(&upper[..upper.len() - 1]);
        Hull { corners }
    }

    /// Reads a hull from a state, which lists the coordinates of the corners: x, y, x, y, ….
    ///
    /// # Errors
    /// A message if the values are not the ordered corners of a hull.
    pub(crate) fn from_values(values: &[f64]) -> Result<Hull, String> {
        let corners: Vec<Place> = values
            .chunks_exact(2)
            .map(|pair| [pair[0], pair[1]])
            .collect();
        let whole = values.len().is_multiple_of(2) && values.iter().all(|value| is_valid(*value));
        let hull = whole.then(|| Hull::of(corners.iter().copied()));
        let same = hull.filter(|hull| hull.corners == corners);
        same.ok_or_else(|| "expected the corners of a convex hull, anticlockwise".to_owned())
    }

    /// Corners, anticlockwise from the leftmost corner.
    pub(crate) fn corners(&self) -> &[Place] {
        &self.corners
    }

    /// True if the hull has no points.
    pub(crate) fn is_empty(&self) -> bool {
        self.corners.is_empty()
    }

    /// Extends the hull by `points`.
    pub(crate) fn extend(&mut self, points: impl IntoIterator<Item = Place>) {
        *self = Hull::of(self.corners.iter().copied().chain(points));
    }

    /// Extends the hull by `other`.
    pub(crate) fn merge(&mut self, other: &Hull) {
        self.extend(other.corners.iter().copied());
    }

    /// Area of the hull, rounded once; 0 if all points are on one line.
    pub(crate) fn area(&self) -> f64 {
        // Halving is exact except for subnormal areas, whose last bit does not matter.
        doubled_area(&self.corners).to_f64() * 0.5
    }

    /// Least and greatest coordinate along `axis`, 0 for x or 1 for y; `None` without points.
    pub(crate) fn extent(&self, axis: usize) -> Option<[f64; 2]> {
        let along = || self.corners.iter().map(|corner| corner[axis]);
        let low = along().min_by(f64::total_cmp)?;
        let high = along().max_by(f64::total_cmp)?;
        Some([low, high])
    }

    /// True if `place` is in the hull or on its edge.
    pub(crate) fn contains(&self, place: Place) -> bool {
        match self.corners[..] {
            [] => false,
            [only] => compare(&only, &place) == Ordering::Equal,
            [start, end] => {
                let between = compare(&start, &place) != Ordering::Greater
                    && compare(&place, &end) != Ordering::Greater;
                between && turn(start, end, place) == Ordering::Equal
            }
            _ => {
                let next = self.corners.iter().cycle().skip(1);
                let mut edges = self.corners.iter().zip(next);
                edges.all(|(&start, &end)| turn(start, end, place) != Ordering::Less)
            }
        }
    }
}

/// Lower or upper half of the hull of sorted points: the corners at which the outline turns left.
///
/// # Reference
/// Andrew, Another efficient algorithm for convex hulls in two dimensions (1979).
fn chain(points: impl Iterator<Item = Place>) -> Vec<Place> {
    let mut chain: Vec<Place> = Vec::new();
    for point in points {
        while let [.., before, last] = chain[..] {
            if turn(before, last, point) == Ordering::Greater {
                break;
            }
            chain.pop();
        }
        chain.push(point);
    }
    chain
}

/// Orders points by x, then by y. Zero and negative zero are equal.
fn compare(left: &Place, right: &Place) -> Ordering {
    let along = |axis: usize| (left[axis] + 0.0).total_cmp(&(right[axis] + 0.0));
    along(0).then_with(|| along(1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use proptest::test_runner::RngSeed;

    fn config() -> ProptestConfig {
        ProptestConfig {
            cases: 200,
            rng_seed: RngSeed::Fixed(2025),
            failure_persistence: None,
            ..ProptestConfig::default()
        }
    }

    /// Points on a coarse grid, so that many share a line, and points of any magnitude.
    fn points() -> impl Strategy<Value = Vec<Place>> {
        let coordinate = prop_oneof![
            6 => (-4_i32..5).prop_map(|step| f64::from(step) * 0.1),
            1 => -1e300..1e300_f64,
        ];
        prop::collection::vec([coordinate.clone(), coordinate], 0..40)
    }

    proptest! {
        #![proptest_config(config())]

        #[test]
        fn a_hull_of_parts_is_the_hull_of_all(points in points(), cut in any::<prop::sample::Index>()) {
            let (left, right) = points.split_at(cut.index(points.len() + 1));
            let whole = Hull::of(points.iter().copied());
            let mut merged = Hull::of(right.iter().copied());
            merged.merge(&Hull::of(left.iter().copied()));
            prop_assert_eq!(&merged, &whole);
            merged.merge(&whole);
            prop_assert_eq!(&merged, &whole);
            let backwards = Hull::of(points.iter().rev().copied());
            prop_assert_eq!(&backwards, &whole);
        }

        #[test]
        fn a_hull_holds_its_points_and_turns_left_at_every_corner(points in points()) {
            let hull = Hull::of(points.iter().copied());
            prop_assert!(points.iter().all(|&point| hull.contains(point)));
            let corners = hull.corners();
            prop_assert!(corners.iter().all(|corner| points.contains(corner)));
            let corner = |at: usize| corners[at % corners.len()];
            for at in 0..if corners.len() < 3 { 0 } else { corners.len() } {
                let left = turn(corner(at), corner(at + 1), corner(at + 2));
                prop_assert_eq!(left, Ordering::Greater);
            }
        }
    }

    #[test]
    fn points_on_an_edge_are_no_corners() {
        let grid =
            (0..5).flat_map(|x| (0..4).map(move |y| [f64::from(x) * 0.1, f64::from(y) * 0.1]));
        let hull = Hull::of(grid);
        let (right, top) = (4.0 * 0.1, 3.0 * 0.1);
        let expected = [[0.0, 0.0], [right, 0.0], [right, top], [0.0, top]];
        assert_eq!(hull.corners(), expected);
        assert_eq!(hull.extent(1), Some([0.0, top]));
        assert!((hull.area() - 0.12).abs() < 1e-16);
        assert!(!hull.contains([right + f64::EPSILON, 0.0]));
    }

    #[test]
    fn a_flat_hull_has_two_corners_and_no_area() {
        let line = (0..9).map(|step| [f64::from(step), f64::from(step)]);
        let hull = Hull::of(line);
        assert_eq!(hull.corners(), [[0.0, 0.0], [8.0, 8.0]]);
        assert_eq!(hull.area().to_bits(), 0.0_f64.to_bits());
        assert!(hull.contains([2.5, 2.5]) && !hull.contains([2.5, 2.6]));
        assert!(!hull.contains([9.0, 9.0]));
        assert!(Hull::default().extent(0).is_none() && Hull::default().is_empty());
    }
}
