//! Interpolates force and pose to the time of a frame, because force, pose and frame are read one after another.

use taceva_core::{Degree, Millimetre, Newton, NewtonMillimetre, Point, Pose, Rotation, Wrench};

/// Force and pose that were read in direct succession.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Look {
    pub(crate) wrench: Wrench,
    pub(crate) wrench_s: f64,
    /// Sequence number of the reading, if the transducer numbers its readings.
    pub(crate) number: Option<u64>,
    pub(crate) pose: Pose,
    pub(crate) pose_s: f64,
}

impl Look {
    /// Later one of the times of force and pose, in s. From this time on, both are known.
    pub(crate) fn since_s(&self) -> f64 {
        self.wrench_s.max(self.pose_s)
    }
}

/// Force and pose at the time `at_s`, interpolated between two readings. Outside the interval between them, the nearer reading applies.
pub(crate) fn between(before: &Look, after: &Look, at_s: f64) -> (Wrench, Pose) {
    let wrench = Mix::new(before.wrench_s, after.wrench_s, at_s);
    let pose = Mix::new(before.pose_s, after.pose_s, at_s);
    (
        wrench.wrench(&before.wrench, &after.wrench),
        pose.pose(&before.pose, &after.pose),
    )
}

/// Force at `at_s`, interpolated between two readings, each with its time in s. Outside the interval between them, the nearer reading applies.
///
/// ```
/// use taceva_core::{Newton, Wrench};
/// use taceva_protocol::wrench_between;
/// let pressed = Wrench { force: [Newton(0.0), Newton(0.0), Newton(2.0)], ..Wrench::default() };
/// let wrench = wrench_between((&Wrench::default(), 1.0), (&pressed, 1.2), 1.05);
/// assert!((wrench.force[2].0 - 0.5).abs() < 1e-9);
/// ```
pub fn wrench_between(before: (&Wrench, f64), after: (&Wrench, f64), at_s: f64) -> Wrench {
    Mix::new(before.1, after.1, at_s).wrench(before.0, after.0)
}

/// Weight of the later value in an interpolation.
struct Mix(f64);

impl Mix {
    /// Computes the weight in whole nanoseconds, as clocks do. Rounding of large times then does not change the result.
    fn new(before_s: f64, after_s: f64, at_s: f64) -> Mix {
        let [span_ns, part_ns] = [after_s, at_s].map(|time_s| ((time_s - before_s) * 1e9).round());
        if span_ns > 0.0 {
            Mix((part_ns / span_ns).clamp(0.0, 1.0))
        } else {
            Mix(1.0)
        }
    }

    /// Interpolated value. At either end of the interval, it is exactly the value of that end.
    fn of(&self, before: f64, after: f64) -> f64 {
        before * (1.0 - self.0) + after * self.0
    }

    fn wrench(&self, before: &Wrench, after: &Wrench) -> Wrench {
        let force =
            [0, 1, 2].map(|axis| Newton(self.of(before.force[axis].0, after.force[axis].0)));
        let torque = [0, 1, 2]
            .map(|axis| NewtonMillimetre(self.of(before.torque[axis].0, after.torque[axis].0)));
        Wrench { force, torque }
    }

    /// Interpolated pose of a tip at rest, whose angles change by less than a turn.
    fn pose(&self, before: &Pose, after: &Pose) -> Pose {
        let (from, to) = (&before.position, &after.position);
        let (from_turn, to_turn) = (&before.rotation, &after.rotation);
        Pose {
            position: Point {
                x: Millimetre(self.of(from.x.0, to.x.0)),
                y: Millimetre(self.of(from.y.0, to.y.0)),
                z: Millimetre(self.of(from.z.0, to.z.0)),
            },
            rotation: Rotation {
                x: Degree(self.of(from_turn.x.0, to_turn.x.0)),
                y: Degree(self.of(from_turn.y.0, to_turn.y.0)),
                z: Degree(self.of(from_turn.z.0, to_turn.z.0)),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn look(at_s: f64, force_n: f64) -> Look {
        let mut wrench = Wrench::default();
        wrench.force[2] = Newton(force_n);
        let mut pose = Pose::default();
        pose.position.z = Millimetre(force_n / 2.0);
        Look {
            wrench,
            wrench_s: at_s,
            number: None,
            pose,
            pose_s: at_s + 0.01,
        }
    }

    #[test]
    fn a_sample_between_two_looks_lies_between_their_values() {
        let (before, after) = (look(1.0, 0.4), look(1.2, 0.8));
        let (wrench, pose) = between(&before, &after, 1.1);
        assert!((wrench.force[2].0 - 0.6).abs() < 1e-12);
        // The pose was read 10 ms later, so 1.1 s is 0.09 s into the 0.2 s between its readings.
        assert!((pose.position.z.0 - 0.29).abs() < 1e-12);
    }

    #[test]
    fn a_sample_is_the_same_to_the_bit_at_every_hour() {
        let at = |hour: f64| {
            let begin_s = 3_600.0 * hour;
            let (before, after) = (look(begin_s + 0.1, 0.4), look(begin_s + 0.237, 0.8));
            let (wrench, pose) = between(&before, &after, begin_s + 0.2);
            [wrench.force[2].0, pose.position.z.0].map(f64::to_bits)
        };
        for hour in [1.0, 7.0, 400.0] {
            assert_eq!(at(hour), at(0.0), "{hour}");
        }
    }

    #[test]
    fn outside_of_both_looks_nothing_is_extrapolated() {
        let (before, after) = (look(1.0, 0.4), look(1.2, 0.8));
        assert_eq!(between(&before, &after, 0.0).0, before.wrench);
        assert_eq!(between(&before, &after, 9.0).0, after.wrench);
        assert_eq!(between(&before, &before, 1.0).0, before.wrench);
    }
}
