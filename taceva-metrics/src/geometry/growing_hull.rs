//! Convex hull of points that arrive in groups, with a fast test for interior points.

use super::hull::Hull;
use super::hull_core::Core;
use super::orientation::Place;

/// Least number of points for which a core, which tests new points fast, saves time.
const LEAST_POINTS: u64 = 64;

/// Convex hull with a core: an inner region that contains most new points, which can then be skipped.
///
/// The core is computed from earlier points, so the hull of all points contains it. The core never changes the hull.
#[derive(Clone, Debug, Default)]
pub(crate) struct GrowingHull {
    hull: Hull,
    core: Option<Core>,
    points: u64,
    /// Number of points when the core was computed.
    points_of_core: u64,
}

impl GrowingHull {
    /// Hull of all points.
    pub(crate) fn hull(&self) -> &Hull {
        &self.hull
    }

    /// Extends the hull by `points`.
    pub(crate) fn extend(&mut self, points: impl IntoIterator<Item = Place>) {
        let mut count = 0;
        let outside = points.into_iter().filter(|&point| {
            count += 1;
            let core = self.core.as_ref();
            !core.is_some_and(|core| core.holds(point) || core.outline_holds(point))
        });
        let outside: Vec<Place> = outside.collect();
        self.points += count;
        if !outside.is_empty() {
            self.hull.extend(outside);
        }
        // The hull grows little while the points double: one core per doubling is enough.
        if self.points >= LEAST_POINTS.max(2 * self.points_of_core) {
            self.core = Core::of(&self.hull);
            self.points_of_core = self.points;
        }
    }

    /// Extends the hull by `other`.
    pub(crate) fn merge(&mut self, other: &Hull) {
        self.hull.merge(other);
    }
}

impl From<Hull> for GrowingHull {
    fn from(hull: Hull) -> GrowingHull {
        GrowingHull {
            hull,
            ..GrowingHull::default()
        }
    }
}

/// Compares only the hulls. Equal sets of points have equal hulls.
impl PartialEq for GrowingHull {
    fn eq(&self, other: &GrowingHull) -> bool {
        self.hull == other.hull
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points near a slanted line, with increasing distance from it.
    fn points() -> Vec<Place> {
        let mut state = 7_u64;
        let mut next = || {
            state = state.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(1);
            f64::from(u32::try_from(state >> 33).expect("31 bits")) / f64::from(1_u32 << 31) - 0.5
        };
        let point = |row: u32| {
            let x = 10.0 * next();
            [x, 0.9 * x + f64::from(row) * 1e-3 * next()]
        };
        (0..5000).map(point).collect()
    }

    #[test]
    fn a_hull_that_grew_is_the_hull_of_all_points_however_they_came() {
        let points = points();
        let expected = Hull::of(points.iter().copied());
        for at_once in [1, 7, 128, 5000] {
            let mut hull = GrowingHull::default();
            points
                .chunks(at_once)
                .for_each(|part| hull.extend(part.iter().copied()));
            assert_eq!(hull.hull(), &expected, "{at_once}");
            assert_eq!(hull, GrowingHull::from(expected.clone()));
        }
        assert_ne!(GrowingHull::default(), GrowingHull::from(expected));
    }

    #[test]
    fn a_merged_hull_goes_on_growing() {
        let points = points();
        let (left, right) = points.split_at(2000);
        let (first, second) = right.split_at(1500);
        let mut hull = GrowingHull::default();
        hull.extend(left.iter().copied());
        hull.merge(&Hull::of(first.iter().copied()));
        hull.extend(second.iter().copied());
        assert_eq!(hull.hull(), &Hull::of(points));
    }
}
