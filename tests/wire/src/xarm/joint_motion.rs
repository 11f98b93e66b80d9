//! Encoding of motions of the joints in commands.

use super::kinematics::Angles;
use super::line::{DIFFERENCE_BYTES, number};

/// Requested motion of the joints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct JointMotion {
    /// Target angles or changes of the angles, rad. An infinite value leaves a joint unchanged.
    angles: [f32; 6],
    pub(super) speed_rad_s: f32,
    /// True if the angles are changes relative to the present angles.
    is_relative: bool,
    /// True if the motion is only checked.
    pub(super) is_only_checked: bool,
}

/// Length of ten values, bytes. The first seven values are angles.
const BYTES: usize = 40;

impl JointMotion {
    /// Parses the motion in the parameters of register 23 or 24; `None` if their length matches no layout.
    pub(super) fn absolute(parameters: &[u8]) -> Option<JointMotion> {
        let (values, checked) = parameters.split_at_checked(BYTES)?;
        JointMotion::of(values, checked, false)
    }

    /// Parses the change of the angles in the parameters of register 83; `None` if they describe a change of the tip's pose.
    pub(super) fn relative(parameters: &[u8]) -> Option<JointMotion> {
        let (values, &[1, _, ref checked @ ..]) = parameters.split_at_checked(DIFFERENCE_BYTES)?
        else {
            return None;
        };
        JointMotion::of(values, checked, true)
    }

    fn of(values: &[u8], checked: &[u8], is_relative: bool) -> Option<JointMotion> {
        (checked.len() <= 1).then(|| JointMotion {
            angles: std::array::from_fn(|index| number(values, index)),
            speed_rad_s: number(values, 7),
            is_relative,
            is_only_checked: checked.first().is_some_and(|switch| *switch != 0),
        })
    }

    /// Target angles of the motion if it begins at the angles `at`, rad.
    pub(super) fn end(&self, at: Angles) -> Angles {
        std::array::from_fn(|joint| match f64::from(self.angles[joint]) {
            angle if angle.is_infinite() => at[joint],
            angle if self.is_relative => at[joint] + angle,
            angle => angle,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(numbers: &[f32]) -> Vec<u8> {
        numbers
            .iter()
            .flat_map(|number| number.to_le_bytes())
            .collect()
    }

    #[test]
    fn joints_go_to_angles_or_by_differences_and_an_infinite_one_stays() {
        let at = [0.5; 6];
        let [none, stays] = [0.0, f32::INFINITY];
        let motion = values(&[
            0.25, stays, stays, stays, stays, stays, none, 0.75, 20.0, none,
        ]);
        let read = JointMotion::absolute(&motion).expect("a motion");
        assert!((read.speed_rad_s - 0.75).abs() < 1e-6 && !read.is_only_checked);
        let end = read.end(at);
        assert!(
            (end[0] - 0.25).abs() < 1e-9 && (end[1] - 0.5).abs() < 1e-9,
            "{end:?}"
        );
        let checked = JointMotion::absolute(&[&motion[..], &[1]].concat()).expect("a motion");
        assert!(checked.is_only_checked);
        assert_eq!(
            JointMotion::absolute(&[&motion[..], &[1, 1]].concat()),
            None
        );

        // `set_servo_angle(servo_id=1, relative=True)` leaves the others infinite since firmware 2.4.101.
        let by = values(&[
            0.25, none, stays, stays, stays, stays, none, 0.75, 20.0, none, -1.0,
        ]);
        let read = JointMotion::relative(&[&by[..], &[1, 0]].concat()).expect("a motion");
        let end = read.end(at);
        let expected = [0.75, 0.5, 0.5, 0.5, 0.5, 0.5];
        let mut apart = end.iter().zip(expected).map(|(one, other)| one - other);
        assert!(apart.all(|rad| rad.abs() < 1e-9), "{end:?}");
        assert_eq!(JointMotion::relative(&[&by[..], &[0, 0]].concat()), None);
    }
}
