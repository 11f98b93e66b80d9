//! What a session on the rig of a rig file begins with: what it must know, what it touches, and what a touch may show to be wrong.

use std::fmt;

use taceva_core::{Specimen, Wrench};

use super::operator::ChangedTouch;
use crate::rig_file::RigFile;

/// What a session must know before it begins.
#[derive(Clone, Debug)]
pub struct SessionSpec<'a> {
    /// The rig.
    pub rig: &'a RigFile,
    /// The robot that somebody must enable by its name; `None` of one that is emulated.
    pub robot: Option<&'a str>,
    /// What earlier sessions of this recording touched.
    pub touched: &'a [ReferenceTouch],
}

/// A gentle touch at the middle of the gel, by which sessions of one recording are compared.
#[derive(Clone, Debug, PartialEq)]
pub struct ReferenceTouch {
    /// The unit of the sensor.
    pub unit: String,
    /// What touched the gel.
    pub specimen: Specimen,
    /// Where the gel begins in the sensor's frame, in mm, positive into the gel.
    pub height_mm: f64,
    /// How deep it was pressed below that, in mm.
    pub depth_mm: f64,
    /// The normal force at that depth, in N.
    pub force_n: f64,
}

impl ReferenceTouch {
    /// How far the gel may seem to have moved between two sessions, in mm: arms come back to tenths.
    const HEIGHT_MM: f64 = 0.1;
    /// And by what part its force may differ.
    const FORCE_PART: f64 = 0.1;

    /// How this touch differs from the `earlier` one, where it does so by more than arms and gels do by themselves.
    pub(super) fn changed_since(&self, earlier: &ReferenceTouch) -> Option<ChangedTouch> {
        let changed = ChangedTouch {
            height_mm: self.height_mm - earlier.height_mm,
            force_part: self.force_n / earlier.force_n - 1.0,
        };
        // What is no number is a change too.
        let is_same = changed.height_mm.abs() <= ReferenceTouch::HEIGHT_MM
            && changed.force_part.abs() <= ReferenceTouch::FORCE_PART;
        (!is_same).then_some(changed)
    }
}

/// How a session began.
#[derive(Clone, Debug, PartialEq)]
pub struct SessionRecord {
    /// The touch.
    pub touch: ReferenceTouch,
    /// What the transducer said while nothing was touched.
    pub zero: Wrench,
    /// Whether a push to +x, and one to +y, was felt: their signs are as the rig file says.
    pub pushes_felt: [bool; 2],
    /// Whether the picture was seen to change in contact, and in contact alone; `false` where no picture is taken.
    pub picture_changed: bool,
    /// From a limit to the halt, in ms; 999 of 1,000 are sooner.
    pub reaction_ms: f64,
    /// How far the tip would go on in that time until it rests, in mm.
    pub overshoot_mm: f64,
}

/// What was wrong with a gentle touch.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum TouchFault {
    /// The force did not rise to what was wanted within half of the depth that is allowed.
    Weak {
        /// What was felt, in N.
        force_n: f64,
        /// What was wanted, in N.
        wanted_n: f64,
        /// At this depth, in mm.
        depth_mm: f64,
    },
    /// A force that stays after the tip has left.
    Clings {
        /// How much, in N.
        force_n: f64,
    },
    /// A picture that is in contact as it is in the air.
    Unseen {
        /// The greatest change of a part of it in contact, in steps of a pixel of 8 bits.
        in_contact: f64,
        /// And in the air.
        in_air: f64,
    },
    /// A picture that stays changed after the tip has left.
    Stays {
        /// The greatest change of a part of it in contact, in steps of a pixel of 8 bits.
        in_contact: f64,
        /// And after it.
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
                "pressed {depth_mm:.3} mm deep the gel was felt with {force_n:.4} N, expected at least {wanted_n:.4} N: see how the transducer is mounted, or what it measures"
            ),
            TouchFault::Clings { force_n } => write!(
                f,
                "{force_n:.4} N stay where the tip left the gel: see whether something clings to it or the transducer drifts"
            ),
            TouchFault::Unseen { in_contact, in_air } => write!(
                f,
                "the picture does not show the touch: a part of it changes by {in_contact:.2} steps in contact and by {in_air:.2} in the air; see whether [sensor] names the camera of this gel, and fix its exposure"
            ),
            TouchFault::Stays { in_contact, after } => write!(
                f,
                "the picture stays changed after the tip left the gel, by {after:.2} of {in_contact:.2} steps: see whether exposure and light are fixed, and whether frames come late (`latency_ms` of [sensor])"
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use taceva_core::Nanometre;

    use super::*;

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
    }
}
