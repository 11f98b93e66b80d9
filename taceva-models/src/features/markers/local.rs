//! Displacement of a point of the gel, computed from nearby markers. It is assumed to be linear in position, which allows stretch, rotation and
//! shear.

use super::spots::distance;

/// A place and its displacement, both in pixels.
pub(super) type Moved = ([f64; 2], [f64; 2]);

/// Distance, in marker spacings, below which the weight of a neighbour hardly grows.
const NEAR: f64 = 0.3;
/// Addend to the diagonal of the normal equations, which keeps gradients small if all neighbours are on one line. A neighbour at a distance of one
/// spacing contributes at most 1.
const STIFF: f64 = 0.05;

/// Displacement at `place`, assumed to be linear in position around it. The fit is by least squares with weights 1 / (distance² + `NEAR`²), in marker
/// spacings. `None` without neighbours.
///
/// The result is `d̄ - G ū`. Here `ū` is the weighted mean of the neighbours' positions relative to `place`, and `d̄` that of their displacements.
/// `G` is the gradient that solves the normal equations, with `STIFF` added to their diagonal.
pub(super) fn displacement(
    place: [f64; 2],
    spacing_px: f64,
    neighbours: &[Moved],
) -> Option<[f64; 2]> {
    let weighted = neighbours.iter().map(|(at, moved)| {
        let off = [0, 1].map(|axis| (at[axis] - place[axis]) / spacing_px);
        let apart = distance(*at, place) / spacing_px;
        (1.0 / (apart * apart + NEAR * NEAR), off, *moved)
    });
    let weighted: Vec<(f64, [f64; 2], [f64; 2])> = weighted.collect();
    let total: f64 = weighted.iter().map(|(weight, ..)| weight).sum();
    if weighted.is_empty() {
        return None;
    }
    let mut middle = [0.0; 2];
    let mut mean = [0.0; 2];
    for (weight, off, moved) in &weighted {
        for axis in 0..2 {
            middle[axis] += weight * off[axis] / total;
            mean[axis] += weight * moved[axis] / total;
        }
    }
    // Second moments of positions, and of positions with displacements.
    let (mut xx, mut xy, mut yy) = (STIFF, 0.0, STIFF);
    let mut with = [[0.0; 2]; 2];
    for (weight, off, moved) in &weighted {
        let [x, y] = [off[0] - middle[0], off[1] - middle[1]];
        let share = weight / total;
        xx += share * x * x;
        xy += share * x * y;
        yy += share * y * y;
        for axis in 0..2 {
            let own = moved[axis] - mean[axis];
            with[axis][0] += share * x * own;
            with[axis][1] += share * y * own;
        }
    }
    // Positive by the Cauchy–Schwarz inequality, because the diagonal is increased.
    let determinant = xx * yy - xy * xy;
    Some([0, 1].map(|axis| {
        let [x, y] = with[axis];
        let gradient = [
            (yy * x - xy * y) / determinant,
            (xx * y - xy * x) / determinant,
        ];
        mean[axis] - gradient[0] * middle[0] - gradient[1] * middle[1]
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_neighbour_is_followed_and_none_says_nothing() {
        assert_eq!(displacement([0.0; 2], 10.0, &[]), None);
        let one = [([8.0, 3.0], [1.5, -2.0])];
        assert_eq!(displacement([0.0; 2], 10.0, &one), Some([1.5, -2.0]));
    }

    #[test]
    fn neighbours_all_around_give_what_lies_between_them() {
        let shear = |[x, y]: [f64; 2]| [2.0 + 0.3 * y, -1.0 + 0.1 * x];
        let around = [[10.0, 0.0], [-10.0, 0.0], [0.0, 10.0], [0.0, -10.0]];
        let moved: Vec<Moved> = around.iter().map(|place| (*place, shear(*place))).collect();
        let found = displacement([0.0; 2], 10.0, &moved).expect("neighbours");
        assert!(distance(found, [2.0, -1.0]) < 1e-12, "{found:?}");
    }

    #[test]
    fn a_row_on_one_side_is_carried_on() {
        let shear = |[x, _]: [f64; 2]| [0.2 * x, 0.0];
        let row = [[-10.0, 0.0], [-20.0, 0.0], [-30.0, 0.0]];
        let moved: Vec<Moved> = row.iter().map(|place| (*place, shear(*place))).collect();
        let found = displacement([0.0; 2], 10.0, &moved).expect("neighbours");
        // Closer to the truth, 0, than to the nearest neighbour, which moves by -2.
        assert!(found[0].abs() < 0.7, "{found:?}");
    }
}
