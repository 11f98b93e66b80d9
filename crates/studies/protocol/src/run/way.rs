//! Distances between places, and comparison of places within the noise of a reported pose.

use taceva_core::{Degree, Millimetre, Point, Pose, Rotation};

/// Greatest difference in rotation that counts as noise of a pose, in degrees. Arms repeat to hundredths of a degree.
const TURN_SLACK_DEG: f64 = 0.1;

/// Greatest sideways displacement of a straight motion, as a share of its depth.
const ASIDE_PART: f64 = 0.01;

/// Distance between two tip positions, in mm.
pub(crate) fn distance(one: &Pose, other: &Pose) -> f64 {
    let (one, other) = (&one.position, &other.position);
    let [x, y] = [one.x.0 - other.x.0, one.y.0 - other.y.0];
    let z = one.z.0 - other.z.0;
    // Most motions are straight down, so this avoids the square roots.
    if x == 0.0 && y == 0.0 {
        return z.abs();
    }
    x.hypot(y).hypot(z)
}

/// Distance of `tip` from the straight line segment between `from` and `to`, in mm.
pub(super) fn distance_from_way(tip: &Pose, from: &Pose, to: &Pose) -> f64 {
    let coordinates = |pose: &Pose| {
        let Point { x, y, z } = pose.position;
        [x.0, y.0, z.0]
    };
    let [tip_mm, from_mm, to_mm] = [tip, from, to].map(coordinates);
    let axes = [0, 1, 2];
    let way = axes.map(|axis| to_mm[axis] - from_mm[axis]);
    let gone = axes.map(|axis| tip_mm[axis] - from_mm[axis]);
    let product = |one: &[f64; 3], other: &[f64; 3]| -> f64 {
        axes.iter().map(|axis| one[*axis] * other[*axis]).sum()
    };
    let length_squared = product(&way, &way);
    if length_squared <= 0.0 {
        return distance(tip, to);
    }
    let part = (product(&gone, &way) / length_squared).clamp(0.0, 1.0);
    distance(tip, &part_way(from, to, part))
}

/// Assumed pose of a tip. A coordinate of `seen` that differs from `sent` by less than `slack_mm` is replaced by that of `sent`.
pub(super) fn settled(seen: &Pose, sent: &Pose, slack_mm: f64) -> Pose {
    let settle = |seen: Millimetre, sent: Millimetre| {
        let is_there = (seen.0 - sent.0).abs() < slack_mm;
        if is_there { sent } else { seen }
    };
    let turn = |seen: Degree, sent: Degree| {
        let is_there = slack_mm > 0.0 && (seen.0 - sent.0).abs() < TURN_SLACK_DEG;
        if is_there { sent } else { seen }
    };
    let (turned, to_turn) = (&seen.rotation, &sent.rotation);
    let (found, meant) = (&seen.position, &sent.position);
    Pose {
        rotation: Rotation {
            x: turn(turned.x, to_turn.x),
            y: turn(turned.y, to_turn.y),
            z: turn(turned.z, to_turn.z),
        },
        position: Point {
            x: settle(found.x, meant.x),
            y: settle(found.y, meant.y),
            z: settle(found.z, meant.z),
        },
    }
}

/// True if a motion goes straight out of the gel. Such a motion is allowed from any place.
pub(super) fn is_straight_up(from: &Pose, to: &Pose) -> bool {
    let (start, end) = (&from.position, &to.position);
    start.x == end.x && start.y == end.y && end.z <= start.z
}

/// True if a motion goes into the gel, and sideways by at most a hundredth of its depth. Transmitted poses are rounded, so exactly 0 is not required.
pub(super) fn is_straight_down(from: &Pose, to: &Pose) -> bool {
    let (start, end) = (&from.position, &to.position);
    let aside_mm = (end.x.0 - start.x.0).hypot(end.y.0 - start.y.0);
    aside_mm <= ASIDE_PART * (end.z.0 - start.z.0)
}

/// Pose at the fraction `part` of the way between two poses, with the rotation of the second pose.
pub(super) fn part_way(from: &Pose, to: &Pose, part: f64) -> Pose {
    let mix = |from: Millimetre, to: Millimetre| Millimetre(from.0 + (to.0 - from.0) * part);
    let (start, end) = (&from.position, &to.position);
    Pose {
        position: Point {
            x: mix(start.x, end.x),
            y: mix(start.y, end.y),
            z: mix(start.z, end.z),
        },
        ..*to
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pose([x, y, z]: [f64; 3]) -> Pose {
        let [x, y, z] = [x, y, z].map(Millimetre);
        Pose {
            position: Point { x, y, z },
            ..Pose::default()
        }
    }

    #[test]
    fn the_distance_from_a_way_is_that_from_its_nearest_place() {
        let (from, to) = (pose([1.0, 2.0, -2.0]), pose([1.0, 2.0, 2.0]));
        for (tip, expected) in [
            ([1.0, 2.0, 0.5], 0.0),
            ([1.3, 2.4, 0.5], 0.5),
            ([1.0, 2.0, 2.75], 0.75),
            ([1.0, 2.0, -2.5], 0.5),
            ([1.0, 5.0, 6.0], 5.0),
        ] {
            let found = distance_from_way(&pose(tip), &from, &to);
            assert!((found - expected).abs() < 1e-12, "{tip:?}: {found}");
        }
        // A line of length 0 is a point.
        let found = distance_from_way(&pose([1.0, 2.0, 1.0]), &to, &to);
        assert!((found - 1.0).abs() < 1e-12, "{found}");
    }

    #[test]
    fn a_tip_is_where_it_was_sent_along_each_axis_on_which_noise_alone_tells_them_apart() {
        let (seen, sent) = (pose([1.03, -2.04, 0.5]), pose([1.0, -2.0, 0.0]));
        let found = settled(&seen, &sent, 0.05);
        assert_eq!(found, pose([1.0, -2.0, 0.5]));
        assert_eq!(settled(&seen, &sent, 0.0), seen);
        assert_eq!(settled(&sent, &sent, 0.0), sent);
    }
}
