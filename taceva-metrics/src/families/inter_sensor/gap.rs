//! Gap between two surfaces in one coordinate frame.

use crate::exact::{Dyadic, ExactSum};
use crate::geometry::{Hull, NearestPoints, Point};
use crate::score::value::UndefinedReason;

/// Mean distances between two surfaces, mm, from each to the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Gap {
    /// Mean distance from points of the first surface to the nearest point of the second, rounded once.
    pub(crate) forward: f64,
    /// Mean distance from points of the second surface to the nearest point of the first, rounded once.
    pub(crate) backward: f64,
    /// Number of points of both surfaces from which a distance was measured.
    pub(crate) points: u64,
}

impl Gap {
    /// Measures the gap between two surfaces where they overlap. A point counts if, seen along z, it lies in the convex hull of the other surface.
    /// The nearest point may be any point of the other surface.
    ///
    /// A distance √(x² + y² + z²) is rounded at every step, and distances are summed exactly.
    ///
    /// # Errors
    /// [`UndefinedReason::NoOverlap`] if no point of one surface is in the hull of the other.
    pub(crate) fn between(first: &[Point], second: &[Point]) -> Result<Gap, UndefinedReason> {
        let (forward, there) = mean_distance(first, second)?;
        let (backward, back) = mean_distance(second, first)?;
        Ok(Gap {
            forward,
            backward,
            points: there + back,
        })
    }

    /// Mean of `forward` and `backward`, mm, rounded once. Lengths are far from over- and underflow.
    pub(crate) fn both(&self) -> f64 {
        (self.forward + self.backward) * 0.5
    }
}

/// Mean distance to the nearest point of `to`, over the points of `from` within the hull of `to`. Also returns the number of these points.
fn mean_distance(from: &[Point], to: &[Point]) -> Result<(f64, u64), UndefinedReason> {
    let seen_from_above = |&[x, y, _]: &Point| [x, y];
    let hull = Hull::of(to.iter().map(seen_from_above));
    let common = from
        .iter()
        .filter(|point| hull.contains(seen_from_above(point)));
    mean_of_nearest(common, to).ok_or(UndefinedReason::NoOverlap)
}

/// Mean distance from each point of `from` to the nearest point of `to`, rounded once, and the number of points of `from`. `None` if there is no
/// point.
fn mean_of_nearest<'a>(from: impl Iterator<Item = &'a Point>, to: &[Point]) -> Option<(f64, u64)> {
    let search = NearestPoints::new(to.iter().copied());
    let (mut count, mut distances) = (0, ExactSum::default());
    for point in from {
        distances.add(search.nearest(*point)?.squared.sqrt());
        count += 1;
    }
    (count > 0).then(|| (distances.to_dyadic().over(&Dyadic::from(count)), count))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The reference file for `inter_sensor` gives mean distances of its point clouds to 45 digits. `TACEVA_GOLDEN` names a folder with another
    /// file.
    #[test]
    fn distances_to_the_nearest_point_are_those_of_the_golden_vectors() {
        let own = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/golden");
        let folder = std::env::var("TACEVA_GOLDEN").unwrap_or_else(|_| own.to_owned());
        let text = std::fs::read_to_string(format!("{folder}/structured.json")).expect("a file");
        let golden: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        let section = &golden["inter_sensor"];
        let seed = section["params"]["seed"].as_u64().expect("a seed");
        let mut random = taceva_core::random::SplitMix64::new(seed);
        let mut below = |bound: u64| {
            f64::from(u32::try_from(random.next_u64() % bound).expect("a small bound"))
        };
        let mut clouds = [Vec::new(), Vec::new()];
        for _ in 0..section["params"]["m"].as_u64().expect("a count") {
            for cloud in &mut clouds {
                cloud.push([below(1000), below(1000), below(100)]);
            }
        }
        let [first, second] = &clouds;
        let gap = Gap {
            forward: mean_of_nearest(first.iter(), second).expect("points").0,
            backward: mean_of_nearest(second.iter(), first).expect("points").0,
            points: 0,
        };
        let close = |found: f64, key: &str| {
            let decimals = section[key].as_str().expect("a decimal number");
            let expected: f64 = decimals.parse().expect("a decimal number");
            assert!(
                (found - expected).abs() <= 1e-15 * expected,
                "{key}: {found}"
            );
        };
        close(gap.forward, "mean_nn_ab");
        close(gap.backward, "mean_nn_ba");
        close(gap.both(), "gap_symmetric");
        for (sum, [from, to]) in [[first, second], [second, first]].into_iter().enumerate() {
            let search = NearestPoints::new(to.iter().copied());
            let nearest = from.iter().filter_map(|point| search.nearest(*point));
            let squares: f64 = nearest.map(|nearest| nearest.squared).sum();
            assert_eq!(Some(squares), section["nn_sq_sum"][sum].as_f64());
        }
    }

    fn sheet(height: f64, shift: f64) -> Vec<Point> {
        let places = (0..36).map(|at| (f64::from(at % 6) + shift, f64::from(at / 6)));
        places.map(|(x, y)| [x, y, height]).collect()
    }

    #[test]
    fn parallel_sheets_are_as_far_apart_as_their_heights() {
        let gap = Gap::between(&sheet(0.0, 0.0), &sheet(0.5, 0.0)).expect("one above the other");
        assert_eq!((gap.forward, gap.backward, gap.points), (0.5, 0.5, 72));
    }

    #[test]
    fn what_only_one_surface_reaches_is_left_out() {
        // Shifted by three columns: three of the six columns of each lie over the other.
        let gap = Gap::between(&sheet(0.0, 0.0), &sheet(0.25, 3.0)).expect("half above the other");
        assert_eq!((gap.forward, gap.backward, gap.points), (0.25, 0.25, 36));
        let apart = Gap::between(&sheet(0.0, 0.0), &sheet(0.0, 9.0));
        assert_eq!(apart, Err(UndefinedReason::NoOverlap));
    }
}
