//! Checks that reject NaN and infinity in values sent to a device or received from a device.

use std::fmt;

use crate::geometry::Pose;
use crate::wrench::Wrench;

/// Checks that every coordinate of `pose` is finite.
///
/// # Errors
/// [`NotFinite`] with the name of the first coordinate that is NaN or infinite.
pub fn check_pose(pose: &Pose) -> Result<(), NotFinite> {
    let Pose { position, rotation } = pose;
    check(&[
        ("x", position.x.0),
        ("y", position.y.0),
        ("z", position.z.0),
        ("rotation about x", rotation.x.0),
        ("rotation about y", rotation.y.0),
        ("rotation about z", rotation.z.0),
    ])
}

/// Checks that every force and torque of `wrench` is finite.
///
/// # Errors
/// [`NotFinite`] with the name of the first component that is NaN or infinite.
pub fn check_wrench(wrench: &Wrench) -> Result<(), NotFinite> {
    let Wrench { force, torque } = wrench;
    check(&[
        ("Fx", force[0].0),
        ("Fy", force[1].0),
        ("Fz", force[2].0),
        ("Tx", torque[0].0),
        ("Ty", torque[1].0),
        ("Tz", torque[2].0),
    ])
}

fn check(named: &[(&'static str, f64)]) -> Result<(), NotFinite> {
    match named.iter().find(|(_, value)| !value.is_finite()) {
        Some(&(name, value)) => Err(NotFinite { name, value }),
        None => Ok(()),
    }
}

/// Error for NaN or infinity where a finite number is required.
///
/// ```
/// use taceva_core::{Newton, Wrench, check_wrench};
/// let wrench = Wrench { force: [Newton(0.0), Newton(0.0), Newton(f64::NAN)], ..Wrench::default() };
/// assert_eq!(check_wrench(&wrench).unwrap_err().to_string(), "`Fz` is NaN, expected a number");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NotFinite {
    name: &'static str,
    value: f64,
}

impl fmt::Display for NotFinite {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}` is {}, expected a number", self.name, self.value)
    }
}

impl std::error::Error for NotFinite {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantity::{Degree, Newton};

    #[test]
    fn the_first_number_that_is_not_finite_is_named() {
        let mut pose = Pose::default();
        assert_eq!(check_pose(&pose), Ok(()));
        pose.rotation.y = Degree(f64::INFINITY);
        assert_eq!(
            check_pose(&pose).expect_err("infinite").to_string(),
            "`rotation about y` is inf, expected a number"
        );
        let mut wrench = Wrench::default();
        wrench.force[2] = Newton(f64::NAN);
        assert_eq!(
            check_wrench(&wrench).expect_err("NaN").to_string(),
            "`Fz` is NaN, expected a number"
        );
    }
}
