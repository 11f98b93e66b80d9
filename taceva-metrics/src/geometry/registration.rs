//! Registration of two clouds without paired points, by the iterative closest point method.

use super::nearest::NearestPoints;
use super::rigid::{Motion, Point};

/// Greatest number of steps of a registration. After these steps it stops without convergence.
const MOST_STEPS: u32 = 50;

/// Rigid motion that registers two point clouds, and the convergence of its search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Registration {
    /// Motion that moves the first cloud onto the second.
    pub(crate) motion: Motion,
    /// True if the last two steps paired the same points, so that further steps change nothing.
    pub(crate) settled: bool,
}

/// Finds the rigid motion of `from` onto `onto`, starting from the given positions. Each step pairs every moved point with the nearest point of
/// `onto`. The step then fits the motion of the original points to these pairs.
///
/// `None` if the pairs do not determine the rotation.
///
/// # Reference
/// Besl and McKay, A method for registration of 3-D shapes (1992).
pub(crate) fn register_clouds(from: &[Point], onto: &[Point]) -> Option<Registration> {
    let search = NearestPoints::new(onto.iter().copied());
    let mut motion = Motion::NONE;
    let mut before: Vec<usize> = Vec::new();
    for _ in 0..MOST_STEPS {
        let nearest = from
            .iter()
            .map(|&point| search.nearest(motion.apply(point)));
        let nearest = nearest.collect::<Option<Vec<_>>>()?;
        let pairing: Vec<usize> = nearest.iter().map(|nearest| nearest.index).collect();
        if pairing == before {
            let settled = true;
            return Some(Registration { motion, settled });
        }
        let partners: Vec<Point> = nearest.iter().map(|nearest| nearest.point).collect();
        motion = Motion::between(from, &partners)?;
        before = pairing;
    }
    let settled = false;
    Some(Registration { motion, settled })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dome() -> Vec<Point> {
        let grid = (0..81).map(|at| {
            let (x, y) = (f64::from(at % 9) - 4.0, f64::from(at / 9) - 4.0);
            [x, y, 5.0 - 0.1 * (x * x + 0.5 * y * y) + 0.02 * x * y]
        });
        grid.collect()
    }

    #[test]
    fn a_dome_that_was_moved_a_little_is_brought_back() {
        let (sine, cosine) = (0.05, (1.0_f64 - 0.05 * 0.05).sqrt());
        let moved = dome().into_iter().map(|[x, y, z]| {
            [
                cosine * x - sine * y + 0.2,
                sine * x + cosine * y - 0.1,
                z + 0.15,
            ]
        });
        let moved: Vec<Point> = moved.collect();
        let found = register_clouds(&moved, &dome()).expect("a surface");
        assert!(found.settled);
        for (moved, original) in moved.iter().zip(dome()) {
            let back = found.motion.apply(*moved);
            assert!((0..3).all(|axis| (back[axis] - original[axis]).abs() < 1e-13));
        }
    }

    #[test]
    fn clouds_that_pair_with_one_point_leave_the_turn_open() {
        assert_eq!(register_clouds(&dome(), &[[0.0; 3]]), None);
        assert_eq!(register_clouds(&dome(), &[]), None);
    }
}
