//! State of the tip when a frame is captured, and changes of this state that every camera shows.

use taceva_core::Pose;

use crate::run::load_limit::Felt;
use crate::run::tip::Tip;
use crate::run::way::distance;

/// Least change of the force that changes the frame of any camera, in multiples of `air_n`.
const FORCE_STEPS: f64 = 5.0;
/// Least displacement of the tip that changes the frame of a camera without noise, in mm. A gel may creep by less under a resting tip.
const MOVED_MM: f64 = 0.05;

/// State of the tip when a frame is captured.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Moment {
    pub(super) felt: Felt,
    pub(super) pose: Pose,
    /// True from the end of a retreat until the next search begins. A light touch in a search does not count as being in the air.
    pub(super) is_in_air: bool,
    /// Force that counts as contact during a motion through the air, in N.
    pub(super) air_n: f64,
}

impl Moment {
    /// Present state of `tip`.
    pub(super) fn of(tip: &Tip<'_>) -> Moment {
        Moment {
            felt: tip.felt,
            pose: tip.at,
            is_in_air: tip.contact_mm.is_none(),
            air_n: tip.pace.air_n,
        }
    }

    /// Magnitude of the change in normal and shear force since `earlier`, in N.
    pub(super) fn change_n(&self, earlier: &Moment) -> f64 {
        let normal_n = self.felt.normal_n - earlier.felt.normal_n;
        let shear_n = self.felt.shear_n - earlier.felt.shear_n;
        normal_n.hypot(shear_n)
    }

    /// True if the force changed enough since `earlier` for every camera to show the change.
    pub(super) fn is_pressed_otherwise_than(&self, earlier: &Moment) -> bool {
        self.change_n(earlier) > FORCE_STEPS * self.air_n
    }

    /// True if the tip is at another place of the gel than at `earlier`, whatever its depth.
    pub(super) fn is_beside(&self, earlier: &Moment) -> bool {
        let (here, there) = (&self.pose.position, &earlier.pose.position);
        (here.x.0 - there.x.0).hypot(here.y.0 - there.y.0) > MOVED_MM
    }

    /// True if the tip moved enough since `earlier` for a camera without noise to show the motion.
    pub(super) fn is_moved_from(&self, earlier: &Moment) -> bool {
        distance(&earlier.pose, &self.pose) > MOVED_MM
    }
}

/// State of a tip that presses a gel of 2 N/mm with `normal_n`.
#[cfg(test)]
pub(super) fn pressed(normal_n: f64) -> Moment {
    let mut pose = Pose::default();
    pose.position.z.0 = normal_n / 2.0;
    Moment {
        felt: Felt {
            normal_n,
            ..Felt::default()
        },
        pose,
        is_in_air: normal_n < 0.01,
        air_n: 0.02,
    }
}
