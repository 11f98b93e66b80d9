//! Core of a convex hull: a region inside the hull, with a fast test for points in it.

use std::cmp::Ordering;

use super::hull::Hull;
use super::orientation::{Place, turn};
use taceva_core::whole_size;

/// Number of stretches (intervals of x) of a core. Fewer stretches make the core smaller; more need more time and cache.
const STRETCHES: u32 = 64;

/// Overlap of neighbouring stretches (intervals of x), as a share of their width. Rounding may assign a point to the next stretch.
const OVERLAP: f64 = 1.0 / 1024.0;

/// Bound on the rounding error of a height, which is y minus a slope times x. The bound is a share of the greatest height.
const MARGIN: f64 = 1.0 / 35_184_372_088_832.0;

/// Core of a hull: a lower and an upper height for each stretch (interval of x). A height is y minus a slope times x, so that the hull is level.
#[derive(Clone, Debug)]
pub(crate) struct Core {
    slope: f64,
    ends: [f64; 2],
    stretches_per_x: f64,
    /// Lower and upper height of the core in each stretch. The core does not reach into a stretch whose lower height exceeds the upper.
    between: Vec<[f64; 2]>,
    /// Lower and upper half of the outline of the hull.
    chains: [Vec<Place>; 2],
}

impl Core {
    /// Core of `hull`; `None` if the hull is flat, or so narrow, small or large that rounding could affect the test.
    pub(crate) fn of(hull: &Hull) -> Option<Core> {
        let [lower, upper] = chains(hull.corners())?;
        let (&[first, left], &[last, right]) = (lower.first()?, lower.last()?);
        let width = last - first;
        let slope = (right - left) / width;
        let greatest = |axis: usize| {
            let along = hull.corners().iter().map(|corner| corner[axis].abs());
            along.fold(0.0, f64::max)
        };
        let size = greatest(1) + slope.abs() * greatest(0);
        let stretches = f64::from(STRETCHES);
        let stretches_per_x = stretches / width;
        let is_plain =
            size > 1e-280 && size < 1e280 && width > greatest(0) * 1e-9 && width > 1e-280;
        if !is_plain || !stretches_per_x.is_finite() {
            return None;
        }
        let place = |stretch: u32, beyond: f64| {
            let share = (f64::from(stretch) + beyond) / stretches;
            (first + share * width).clamp(first, last)
        };
        let (mut below, mut above) = (Heights::of(&lower, slope), Heights::of(&upper, slope));
        let between = (0..STRETCHES).map(|stretch| {
            // The lower chain is convex and the upper one concave: heights inside at both ends are inside between them.
            let places = [place(stretch, -OVERLAP), place(stretch, 1.0 + OVERLAP)];
            let [low, high] = [places.map(|x| below.at(x)), places.map(|x| above.at(x))];
            let margin = size * MARGIN;
            [low[0].max(low[1]) + margin, high[0].min(high[1]) - margin]
        });
        Some(Core {
            between: between.collect(),
            slope,
            ends: [first, last],
            stretches_per_x,
            chains: [lower, upper],
        })
    }

    /// True if the point at `place` is in the core. If false, the point may still be in the hull.
    #[inline]
    pub(crate) fn holds(&self, [x, y]: Place) -> bool {
        let [first, last] = self.ends;
        let stretch = (x - first) * self.stretches_per_x;
        if !(stretch >= 0.0 && x <= last) {
            return false;
        }
        let found = self.between.get(whole_size(stretch));
        let height = y - self.slope * x;
        found.is_some_and(|[low, high]| *low < height && height < *high)
    }
}

impl Core {
    /// True if the point at `place` is in the hull or on its edge. The test compares the point with the hull's edges above and below the point.
    pub(crate) fn outline_holds(&self, place: Place) -> bool {
        let [first, last] = self.ends;
        let along = |chain: &[Place]| {
            let after = chain.partition_point(|corner| corner[0] <= place[0]);
            let after = after.clamp(1, chain.len() - 1);
            turn(chain[after - 1], chain[after], place)
        };
        let [lower, upper] = &self.chains;
        let is_beside = place[0] < first || place[0] > last;
        !is_beside && along(lower) != Ordering::Less && along(upper) != Ordering::Greater
    }
}

/// Lower and upper half of the outline, both from left to right and without vertical edges; `None` for a flat hull.
fn chains(corners: &[Place]) -> Option<[Vec<Place>; 2]> {
    let (&[first, _], &[before, _]) = (corners.first()?, corners.last()?);
    let last = corners.iter().map(|[x, _]| *x).fold(first, f64::max);
    let at_last = |[x, _]: &Place| *x >= last;
    let (lower_end, upper_end) = (
        corners.iter().position(at_last)?,
        corners.iter().rposition(at_last)?,
    );
    if corners.len() < 3 || first >= last {
        return None;
    }
    let mut upper = Vec::with_capacity(corners.len());
    if before > first {
        upper.push(corners[0]);
    }
    upper.extend(corners[upper_end..].iter().rev());
    Some([corners[..=lower_end].to_vec(), upper])
}

/// Heights of the lower or upper half of a hull, read at places from left to right.
struct Heights {
    corners: Vec<Place>,
    at: usize,
}

impl Heights {
    fn of(chain: &[Place], slope: f64) -> Heights {
        let flat = |&[x, y]: &Place| [x, y - slope * x];
        Heights {
            corners: chain.iter().map(flat).collect(),
            at: 0,
        }
    }

    fn at(&mut self, x: f64) -> f64 {
        // The next stretch begins before the end of the last one.
        while self.at > 0 && self.corners[self.at][0] > x {
            self.at -= 1;
        }
        while self.at + 2 < self.corners.len() && self.corners[self.at + 1][0] < x {
            self.at += 1;
        }
        let [[from, low], [to, high]] = [self.corners[self.at], self.corners[self.at + 1]];
        let share = ((x - from) / (to - from)).clamp(0.0, 1.0);
        low + share * (high - low)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use proptest::test_runner::RngSeed;

    fn coordinate() -> impl Strategy<Value = f64> {
        prop_oneof![
            6 => -1.0..1.0_f64,
            2 => (-4_i32..5).prop_map(|step| f64::from(step) * 0.25),
            1 => -1e9..1e9_f64,
        ]
    }

    fn points(count: std::ops::Range<usize>) -> impl Strategy<Value = Vec<Place>> {
        prop::collection::vec([coordinate(), coordinate()], count)
    }

    proptest! {
        #![proptest_config(ProptestConfig {
            cases: 400,
            rng_seed: RngSeed::Fixed(2025),
            failure_persistence: None,
            ..ProptestConfig::default()
        })]

        #[test]
        fn what_a_core_holds_is_in_its_hull(
            corners in points(3..30),
            others in points(0..60),
            weights in prop::collection::vec(0.0..1.0_f64, 60),
        ) {
            let hull = Hull::of(corners.iter().copied());
            let Some(core) = Core::of(&hull) else { return Ok(()) };
            // Other points, and points on edges up to rounding, which are inside or outside.
            let ends = hull.corners().iter().zip(hull.corners().iter().cycle().skip(1));
            let on_edges = ends.cycle().zip(&weights).map(|((start, end), weight)| {
                [0, 1].map(|axis| start[axis] + weight * (end[axis] - start[axis]))
            });
            for place in others.iter().copied().chain(on_edges).chain(corners.iter().copied()) {
                prop_assert!(!core.holds(place) || hull.contains(place), "{:?}", place);
                prop_assert_eq!(core.outline_holds(place), hull.contains(place), "{:?}", place);
            }
        }
    }

    #[test]
    fn nearly_all_of_a_slanted_hull_is_in_its_core() {
        let at = |step: u32| f64::from(step) * 0.001 - 0.5;
        let outline =
            (0..1000).flat_map(|step| [[at(step), at(step) + 0.2], [at(step), at(step) - 0.2]]);
        let core = Core::of(&Hull::of(outline)).expect("no flat hull");
        let inside = (0..1000).flat_map(|step| {
            (0..39).map(move |up| [at(step), at(step) + f64::from(up) * 0.01 - 0.19])
        });
        let (held, all) = inside.fold((0, 0), |(held, all), place| {
            (held + u32::from(core.holds(place)), all + 1)
        });
        assert!(held > all * 9 / 10, "{held} of {all}");
        assert!(!core.holds([f64::NAN, 0.0]) && !core.holds([0.0, f64::NAN]));
        assert!(!core.holds([-0.6, -0.6]) && !core.holds([0.6, 0.6]));
    }

    #[test]
    fn a_hull_that_rounding_could_decide_has_no_core() {
        let square = |size: f64| Hull::of([[0.0, 0.0], [size, 0.0], [size, size], [0.0, size]]);
        assert!(Core::of(&square(1.0)).is_some());
        for size in [1e-300, 1e300] {
            assert!(Core::of(&square(size)).is_none(), "{size:e}");
        }
        let narrow = Hull::of([[1e9, 0.0], [1e9 + 0.5, 0.0], [1e9, 1.0]]);
        assert!(Core::of(&narrow).is_none());
        assert!(Core::of(&Hull::of([[0.0, 0.0], [1.0, 1.0]])).is_none());
        assert!(Core::of(&Hull::of([[0.0, 0.0], [0.0, 1.0], [0.0, 2.0]])).is_none());
    }
}
