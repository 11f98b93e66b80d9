//! Start of a session on the rig of a rig file: inputs, reference touch, and faults that the touch reveals.

use std::fmt;

use taceva_core::{Specimen, Wrench};

use super::operator::ChangedTouch;
use crate::rig_file::RigFile;

/// Inputs of a session.
#[derive(Clone, Debug)]
pub struct SessionSpec<'a> {
    /// Rig file of the rig.
    pub rig: &'a RigFile,
    /// Name of the robot that the operator must enable; `None` for an emulated robot.
    pub robot: Option<&'a str>,
    /// Reference touches of earlier sessions of this recording, oldest first.
    pub touched: &'a [ReferenceTouch],
}

/// A gentle touch at the middle of the gel, for the comparison of the sessions of one recording.
#[derive(Clone, Debug, PartialEq)]
pub struct ReferenceTouch {
    /// Unit of the sensor.
    pub unit: String,
    /// Specimen that touched the gel.
    pub specimen: Specimen,
    /// Height of the gel along z of the sensor frame, in mm, positive into the gel.
    pub height_mm: f64,
    /// Depth of the touch below the height of the gel, in mm.
    pub depth_mm: f64,
    /// Normal force at depth `depth_mm`, in N.
    pub force_n: f64,
    /// Standard uncertainty of the height, in mm.
    pub height_u_mm: f64,
    /// Standard uncertainty of the force, in N, including the uncertainty of the depth.
    pub force_u_n: f64,
}

impl ReferenceTouch {
    /// Greatest apparent change of the gel height between two sessions that counts as no change, in mm. Arms repeat to about 0.1 mm.
    const HEIGHT_MM: f64 = 0.1;
    /// Greatest relative change of the stiffness between two sessions that counts as no change.
    const FORCE_PART: f64 = 0.1;
    /// Coverage factor of the uncertainty of a change.
    const COVERAGE: f64 = 2.0;

    /// Stiffness of the gel: force divided by depth, in N/mm.
    pub fn stiffness_n_mm(&self) -> f64 {
        self.force_n / self.depth_mm
    }

    /// Message for the operator: the stiffness in this and in the `earlier` touch.
    pub(super) fn line(&self, earlier: Option<&ReferenceTouch>) -> String {
        let stiffness = self.stiffness_n_mm();
        let beside = match earlier {
            Some(earlier) => {
                let before = earlier.stiffness_n_mm();
                let change = 100.0 * (stiffness / before - 1.0);
                format!("{before:.3} N/mm in the last session ({change:+.1} %)")
            }
            None => {
                "if this stiffness is wrong by a factor of about 4.4 or 9.8, the unit of force is wrong".to_owned()
            }
        };
        format!(
            "gentle touch with the {}: {:.3} N at {:.3} mm, {stiffness:.3} N/mm; {beside}",
            self.specimen, self.force_n, self.depth_mm
        )
    }

    /// Change since the `earlier` touch. `None` if the change is within the repeatability of arms and gels, or within the uncertainty of both
    /// touches.
    pub(super) fn changed_since(&self, earlier: &ReferenceTouch) -> Option<ChangedTouch> {
        let part = |touch: &ReferenceTouch| touch.force_u_n / touch.force_n;
        let changed = ChangedTouch {
            height_mm: self.height_mm - earlier.height_mm,
            force_part: self.stiffness_n_mm() / earlier.stiffness_n_mm() - 1.0,
            height_u_mm: ReferenceTouch::COVERAGE * self.height_u_mm.hypot(earlier.height_u_mm),
            force_u_part: ReferenceTouch::COVERAGE * part(self).hypot(part(earlier)),
        };
        // NaN counts as a change.
        let is_same = changed.height_mm.abs() <= ReferenceTouch::HEIGHT_MM.max(changed.height_u_mm)
            && changed.force_part.abs() <= ReferenceTouch::FORCE_PART.max(changed.force_u_part);
        (!is_same).then_some(changed)
    }
}

/// Record of the start of a session.
#[derive(Clone, Debug, PartialEq)]
pub struct SessionRecord {
    /// Reference touch.
    pub touch: ReferenceTouch,
    /// Force and torque reported without contact, before the transducer set its own zero.
    pub zero: Wrench,
    /// For the sideways pushes to +x and +y: true if the force had the sign that the rig file states.
    pub pushes_felt: [bool; 2],
    /// True if the frames changed in contact but not in the air; false without frames.
    pub picture_changed: bool,
    /// Time from an exceeded limit to the halt, in ms: the 99.9th percentile.
    pub reaction_ms: f64,
    /// Travel of the tip from an exceeded limit until the tip is at rest, in mm.
    pub overshoot_mm: f64,
}

/// Faults found by a reference touch.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum TouchFault {
    /// The force did not reach the wanted force within half of the allowed depth.
    Weak {
        /// Force, in N.
        force_n: f64,
        /// Wanted force, in N.
        wanted_n: f64,
        /// Depth reached, in mm.
        depth_mm: f64,
    },
    /// The normal force does not return to zero after the tip has left the gel.
    Clings {
        /// Remaining force, in N.
        force_n: f64,
    },
    /// The frames do not change in contact.
    Unseen {
        /// Greatest change of mean brightness in contact, over equal parts of the frame, in steps of an 8-bit pixel.
        in_contact: f64,
        /// Greatest change of mean brightness in the air, over equal parts of the frame, in steps of an 8-bit pixel.
        in_air: f64,
    },
    /// The frames remain changed after the tip has left the gel.
    Stays {
        /// Greatest change of mean brightness in contact, over equal parts of the frame, in steps of an 8-bit pixel.
        in_contact: f64,
        /// Greatest change of mean brightness after contact, over equal parts of the frame, in steps of an 8-bit pixel.
        after: f64,
    },
}

impl fmt::Display for TouchFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            TouchFault::Weak {
                force_n,
                wanted_n,
                depth_mm,
            } => write!(
                f,
                "at {depth_mm:.3} mm depth the force is {force_n:.4} N, expected at least {wanted_n:.4} N: check the mounting and the signal of the transducer"
            ),
            TouchFault::Clings { force_n } => write!(
                f,
                "{force_n:.4} N remain after the tip left the gel: check whether something sticks to the tip or the transducer drifts"
            ),
            TouchFault::Unseen { in_contact, in_air } => write!(
                f,
                "the picture does not show the touch: its greatest change is {in_contact:.2} grey levels in contact and {in_air:.2} in the air; check that [sensor] names the camera of this gel, and set a fixed exposure"
            ),
            TouchFault::Stays { in_contact, after } => write!(
                f,
                "the picture is still changed by {after:.2} of {in_contact:.2} grey levels after the tip left the gel: fix exposure and light, and check whether frames are late (`latency_ms` of [sensor])"
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use taceva_core::Nanometre;

    use super::*;

    #[test]
    fn a_touch_states_its_stiffness_beside_that_of_the_last_session() {
        let touch = |force_n: f64| ReferenceTouch {
            unit: "1".to_owned(),
            specimen: Specimen::Sphere {
                radius: Nanometre(4_000_000),
            },
            height_mm: 0.1,
            depth_mm: 0.3,
            force_n,
            height_u_mm: 0.0,
            force_u_n: 0.0,
        };
        let line = touch(0.6).line(Some(&touch(0.48)));
        assert_eq!(
            line,
            "gentle touch with the sphere of radius 4 mm: 0.600 N at 0.300 mm, 2.000 N/mm; 1.600 N/mm in the last session (+25.0 %)"
        );
        assert!(touch(0.6).line(None).contains("the unit of force is wrong"));
    }

    #[test]
    fn a_gel_that_moved_by_more_than_a_tenth_or_presses_by_more_than_a_tenth_otherwise_is_changed()
    {
        let touch = |height_mm: f64, force_n: f64| ReferenceTouch {
            unit: "1".to_owned(),
            specimen: Specimen::Sphere {
                radius: Nanometre(4_000_000),
            },
            height_mm,
            depth_mm: 0.2,
            force_n,
            height_u_mm: 0.0,
            force_u_n: 0.0,
        };
        let earlier = touch(0.1, 0.06);
        for (height_mm, force_n, is_changed) in [
            (0.1, 0.06, false),
            (0.19, 0.0655, false),
            (0.01, 0.0545, false),
            (0.21, 0.06, true),
            (-0.01, 0.06, true),
            (0.1, 0.067, true),
            (0.1, 0.053, true),
            (0.1, f64::NAN, true),
        ] {
            let changed = touch(height_mm, force_n).changed_since(&earlier);
            assert_eq!(changed.is_some(), is_changed, "{height_mm} mm, {force_n} N");
        }
        // A difference within the uncertainty of both touches is not a change.
        let unsure = |height_mm: f64, force_n: f64| ReferenceTouch {
            height_u_mm: 0.05,
            force_u_n: 0.006,
            ..touch(height_mm, force_n)
        };
        let earlier = unsure(0.1, 0.06);
        for (height_mm, force_n, is_changed) in [
            (0.23, 0.06, false),
            (0.1, 0.075, false),
            (0.25, 0.06, true),
            (0.1, 0.09, true),
        ] {
            let changed = unsure(height_mm, force_n).changed_since(&earlier);
            assert_eq!(changed.is_some(), is_changed, "{height_mm} mm, {force_n} N");
        }
    }
}
