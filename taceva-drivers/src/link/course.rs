//! Straight path of an arm that is driven by velocity commands. Each command expires after a short time.

use std::time::Duration;

use taceva_core::{Pose, Speed};

/// Interval between velocity commands. The arm tolerates the loss of three commands in a row.
pub(crate) const RENEWED: Duration = Duration::from_millis(50);
/// Remaining time below which one line command replaces the velocity commands. Only a line command ends exactly at the target.
pub(crate) const LINE: Duration = Duration::from_millis(100);
/// Shortest duration of a path that is driven by velocity commands. A shorter path is one line command, because changing the type of motion takes
/// time.
const WORTH: Duration = Duration::from_millis(300);
/// Maximum turn of the tool, in degrees about each axis, that still counts as no rotation.
const TURNED_DEG: f64 = 0.01;

/// Straight path without rotation, in the base frame of the arm.
#[derive(Debug)]
pub(crate) struct Course {
    to_mm: [f64; 3],
    velocity_mm_s: [f64; 3],
    speed_mm_s: f64,
}

impl Course {
    /// Creates the path from the pose `from` to `target`. `None` if the path is too short for velocity commands, its length is not finite, or the
    /// tool rotates.
    pub(crate) fn of(from: &Pose, target: &Pose, speed: Speed) -> Option<Course> {
        let turns = [
            (from.rotation.x.0, target.rotation.x.0),
            (from.rotation.y.0, target.rotation.y.0),
            (from.rotation.z.0, target.rotation.z.0),
        ];
        let turns = turns.map(|(from, to)| (to - from).rem_euclid(360.0));
        let is_turned = |turn: f64| turn.min(360.0 - turn) > TURNED_DEG;
        let (from_mm, to_mm) = (place(from), place(target));
        let way_mm = [0, 1, 2].map(|axis| to_mm[axis] - from_mm[axis]);
        let (length_mm, speed_mm_s) = (length(way_mm), speed.mm_per_s());
        let is_short = length_mm <= speed_mm_s * WORTH.as_secs_f64();
        // A pose with NaN has no length.
        if turns.into_iter().any(is_turned) || is_short || !length_mm.is_finite() {
            return None;
        }
        let velocity_mm_s = way_mm.map(|side| side / length_mm * speed_mm_s);
        Some(Course {
            to_mm,
            velocity_mm_s,
            speed_mm_s,
        })
    }

    /// Remaining duration from the observed pose `seen`; zero after the end of the path.
    pub(crate) fn left(&self, seen: &Pose) -> Duration {
        let at_mm = place(seen);
        let along = |axis: usize| (self.to_mm[axis] - at_mm[axis]) * self.velocity_mm_s[axis];
        let left_s = (along(0) + along(1) + along(2)) / self.speed_mm_s.powi(2);
        Duration::try_from_secs_f64(left_s.max(0.0)).unwrap_or_default()
    }

    /// Velocity of the tip, mm/s.
    pub(crate) fn velocity_mm_s(&self) -> [f64; 3] {
        self.velocity_mm_s
    }
}

fn place(pose: &Pose) -> [f64; 3] {
    [pose.position.x.0, pose.position.y.0, pose.position.z.0]
}

fn length([x, y, z]: [f64; 3]) -> f64 {
    x.hypot(y).hypot(z)
}

#[cfg(test)]
mod tests {
    use taceva_core::{Degree, Millimetre};

    use super::*;

    fn at(x: f64, z: f64) -> Pose {
        let mut pose = Pose::default();
        (pose.position.x, pose.position.z) = (Millimetre(x), Millimetre(z));
        pose
    }

    #[test]
    fn what_is_left_is_the_way_along_the_course_and_short_or_turned_ways_have_none() {
        let speed = Speed::try_new(5.0).expect("above 0");
        let course = Course::of(&at(0.0, 0.0), &at(3.0, -4.0), speed).expect("a second");
        let [x, y, z] = course.velocity_mm_s();
        assert!((x - 3.0).abs() < 1e-12 && y.abs() < 1e-12 && (z + 4.0).abs() < 1e-12);
        let left_s = |x, z| course.left(&at(x, z)).as_secs_f64();
        assert!((left_s(0.0, 0.0) - 1.0).abs() < 1e-9);
        assert!((left_s(1.5, -2.0) - 0.5).abs() < 1e-9);
        // Off the path the nearest point counts. Past the end no duration is left.
        assert!((left_s(1.5 + 0.4, -2.0 + 0.3) - 0.5).abs() < 1e-9);
        assert!(left_s(6.0, -8.0) < 1e-12);
        assert!(Course::of(&at(0.0, 0.0), &at(0.0, 1.5), speed).is_none());
        assert!(Course::of(&at(0.0, 0.0), &at(f64::NAN, 9.0), speed).is_none());
        let mut turned = at(0.0, 9.0);
        turned.rotation.z = Degree(0.1);
        assert!(Course::of(&at(0.0, 0.0), &turned, speed).is_none());
        turned.rotation.z = Degree(360.0);
        assert!(Course::of(&at(0.0, 0.0), &turned, speed).is_some());
    }
}
