//! Search for the point nearest to a place. The first of equally near points is found.

use super::rigid::Point;

use crate::exact::number_key::ranked;

/// Points sorted by x, for a nearest-point search that skips most points.
///
/// The search skips points by x alone, so points that share one x are all visited.
///
/// ```
/// use taceva_metrics::NearestPoints;
/// let search = NearestPoints::new([[0.0, 0.0, 0.0], [3.0, 4.0, 0.0]]);
/// let found = search.nearest([3.0, 3.0, 0.0]).ok_or("two points")?;
/// assert_eq!((found.index, found.squared), (1, 1.0));
/// # Ok::<(), &str>(())
/// ```
#[derive(Clone, Debug)]
pub struct NearestPoints {
    /// Points with their indices, sorted by x, then by index.
    sorted: Vec<(Point, usize)>,
}

/// Point that a nearest-point search found.
///
/// ```
/// use taceva_metrics::NearestPoints;
/// let nearest = NearestPoints::new([[1.0, 2.0, 3.0]]).nearest([0.0; 3]);
/// assert_eq!(nearest.map(|found| found.squared.sqrt()), Some(14.0_f64.sqrt()));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Nearest {
    /// Index of the point in the given order.
    pub index: usize,
    /// Coordinates of the point.
    pub point: [f64; 3],
    /// Squared distance from the searched place, as the rounded sum of three rounded squares.
    pub squared: f64,
}

impl NearestPoints {
    /// Sorts `points` for searches. Of equally near points, a search returns the first in the given order.
    pub fn new(points: impl IntoIterator<Item = [f64; 3]>) -> NearestPoints {
        let points: Vec<Point> = points.into_iter().collect();
        let order = ranked(points.len(), &|left, right| {
            points[left][0].total_cmp(&points[right][0])
        });
        let sorted = order.into_iter().map(|index| (points[index], index));
        NearestPoints {
            sorted: sorted.collect(),
        }
    }

    /// Point nearest to `place`; `None` without points.
    pub fn nearest(&self, place: [f64; 3]) -> Option<Nearest> {
        let middle = self
            .sorted
            .partition_point(|(point, _)| point[0] < place[0]);
        let (left, right) = self.sorted.split_at(middle);
        let mut best = None;
        // A squared distance is at least its part along x, even rounded. Beyond this part, no point is nearer or equally near.
        for (points, backwards) in [(right, false), (left, true)] {
            let mut visit =
                |&(point, index): &(Point, usize)| closer(&mut best, place, point, index);
            if backwards {
                points.iter().rev().all(&mut visit);
            } else {
                points.iter().all(&mut visit);
            }
        }
        best
    }
}

/// Replaces `best` if `point` is nearer to `place`. Returns true if points further along x can be as near as `best`.
fn closer(best: &mut Option<Nearest>, place: Point, point: Point, index: usize) -> bool {
    let [x, y, z]: Point = std::array::from_fn(|axis| point[axis] - place[axis]);
    let along = x * x;
    let squared = along + y * y + z * z;
    match best {
        Some(best) if along > best.squared => return false,
        Some(best) if (squared, index) >= (best.squared, best.index) => {}
        _ => {
            *best = Some(Nearest {
                index,
                point,
                squared,
            });
        }
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_is_that_of_a_full_search_and_ties_go_to_the_first() {
        // A grid: every place between two of its points has ties.
        let points: Vec<Point> = (0..60)
            .map(|at| {
                [
                    f64::from(at * 7 % 5),
                    f64::from(at * 7 / 5 % 4),
                    f64::from(at % 3),
                ]
            })
            .collect();
        let search = NearestPoints::new(points.iter().copied());
        for at in 0..500 {
            let place = [
                f64::from(at % 11) * 0.5,
                f64::from(at % 9) * 0.5,
                f64::from(at % 5) * 0.5,
            ];
            let squared = |point: Point| {
                let [x, y, z]: Point = std::array::from_fn(|axis| point[axis] - place[axis]);
                x * x + y * y + z * z
            };
            let best = points
                .iter()
                .map(|&point| squared(point))
                .fold(f64::INFINITY, f64::min);
            let first = points.iter().position(|&point| squared(point) <= best);
            let found = search.nearest(place).expect("points");
            assert_eq!(Some(found.index), first, "{place:?}");
            assert_eq!(found.squared.to_bits(), best.to_bits());
        }
    }

    #[test]
    fn no_point_is_near_to_anything() {
        assert_eq!(NearestPoints::new([]).nearest([0.0; 3]), None);
    }
}
