//! What a rig would write down of a press.

use taceva_core::{Millimetre, Newton, Point, Pose, Wrench};

/// The label of a press as the rig logs it, errors included, in the signs of the project.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Label {
    /// Px, Py: where the robot was sent, shear included; Pz: its travel after the contact it detected, positive into the gel.
    pub position_mm: [f64; 3],
    /// Fx, Fy, Fz: what the transducer said, Fz positive in compression.
    pub force_n: [f64; 3],
}

impl Label {
    /// The position as a pose.
    pub fn pose(&self) -> Pose {
        let [x, y, z] = self.position_mm.map(Millimetre);
        Pose {
            position: Point { x, y, z },
            ..Pose::default()
        }
    }

    /// The force as a wrench; nothing is known of torques.
    pub fn wrench(&self) -> Wrench {
        Wrench {
            force: self.force_n.map(Newton),
            ..Wrench::default()
        }
    }
}
