//! Label of a press, as recorded by a rig.

use taceva_core::{Millimetre, Newton, Point, Pose, Wrench};

/// Label of a press, with the errors of the rig, in the sign convention of the project.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Label {
    /// Px, Py: target of the robot, shear included; Pz: its travel after detected contact, positive into the gel.
    pub position_mm: [f64; 3],
    /// Fx, Fy, Fz: reading of the transducer, Fz positive in compression.
    pub force_n: [f64; 3],
}

impl Label {
    /// Position as a pose.
    pub fn pose(&self) -> Pose {
        let [x, y, z] = self.position_mm.map(Millimetre);
        Pose {
            position: Point { x, y, z },
            ..Pose::default()
        }
    }

    /// Force as a wrench. Torques are 0, because they are not measured.
    pub fn wrench(&self) -> Wrench {
        Wrench {
            force: self.force_n.map(Newton),
            ..Wrench::default()
        }
    }
}
