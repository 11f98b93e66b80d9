//! How far the tip goes in one motion where it may touch the gel.
//!
//! Alone, a run sees a limit only at the end of a motion, so that motions are segments of 15 ms. Where threads look on, they halt within a
//! motion. It may be longer then, but only where it would pass no limit if nobody looked: what is stated of the overshoot holds for a
//! guard that is late, too.

use taceva_core::Pose;

use super::supervisor::MotionStage;
use super::tip::Tip;
use super::way::{is_straight_down, is_straight_up};

/// The longest motion near the gel, in mm: a robot whose host is gone goes no further.
const LONGEST_MM: f64 = 1.0;
/// From a tip that feels nothing, this part of the depth that the gel is pressed to passes no limit of it.
const UNFELT_PART: f64 = 0.125;
/// So many times what a gel has shown of its stiffness it is taken to be further down: one that is felt as by Hertz is 1.5 times as stiff as
/// its force by its depth.
const STIFFER: f64 = 3.0;

/// What a gel bears.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bearing {
    pub(super) depth_max_mm: f64,
    pub(super) normal_max_n: f64,
    /// Less than this is nothing.
    pub(super) threshold_n: f64,
}

impl Bearing {
    /// How much deeper the gel may be pressed at once that bears `force_n` at `depth_mm`, in mm.
    fn room_mm(&self, depth_mm: f64, force_n: f64) -> f64 {
        let force_n = force_n.abs().max(self.threshold_n);
        let stiffness_n_mm = STIFFER * force_n / depth_mm.max(0.0);
        let by_force_mm = (self.normal_max_n - force_n) / stiffness_n_mm;
        let by_depth_mm = self.depth_max_mm - depth_mm;
        by_force_mm.min(by_depth_mm).max(0.0)
    }

    /// How far the tip may go at once that feels nothing.
    fn unfelt_mm(&self) -> f64 {
        UNFELT_PART * self.depth_max_mm
    }
}

impl Tip<'_> {
    /// The length of the next motion from `here` towards `goal`, in mm.
    pub(super) fn stride_mm(&self, here: &Pose, goal: &Pose) -> f64 {
        let segment_mm = self.pace.segment_mm;
        if !self.is_guarded {
            return segment_mm;
        }
        let bearing = &self.pace.bearing;
        let stride_mm = match self.stage {
            MotionStage::Travel { .. } => LONGEST_MM,
            MotionStage::Retreat { .. } if is_straight_up(here, goal) => LONGEST_MM,
            MotionStage::Search if is_straight_down(here, goal) => bearing.unfelt_mm(),
            MotionStage::Press { height_mm } if is_straight_down(here, goal) => {
                bearing.room_mm(here.position.z.0 - height_mm, self.felt_n)
            }
            _ => segment_mm,
        };
        stride_mm.clamp(segment_mm, LONGEST_MM.max(segment_mm))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GEL: Bearing = Bearing {
        depth_max_mm: 1.0,
        normal_max_n: 1.8,
        threshold_n: 0.02,
    };

    #[test]
    fn a_stride_passes_no_limit_of_a_gel_that_is_three_times_as_stiff_further_down() {
        for depth_mm in [0.01, 0.1, 0.3, 0.6, 0.9, 1.0] {
            for stiffness_n_mm in [0.2, 1.0, 3.0] {
                let force_n = stiffness_n_mm * depth_mm;
                let room_mm = GEL.room_mm(depth_mm, force_n);
                let after_n = force_n + 3.0 * stiffness_n_mm * room_mm;
                assert!(room_mm >= 0.0 && depth_mm + room_mm <= 1.0 + 1e-12);
                assert!(after_n <= 1.8 + 1e-9 || force_n > 1.8, "{after_n} N");
            }
        }
    }

    #[test]
    fn at_a_limit_and_at_the_first_contact_there_is_no_room() {
        assert!(GEL.room_mm(1.0, 0.5) <= 0.0);
        assert!(GEL.room_mm(0.5, 1.8) <= 0.0);
        assert!(GEL.room_mm(0.5, 2.5) <= 0.0);
        assert!(GEL.room_mm(0.0, 0.5) <= 0.0);
        // 1.75 N are left of a gel that is taken to be of 0.5 N/mm, but the depth ends before.
        assert!((GEL.room_mm(0.3, 0.05) - 0.7).abs() < 1e-12);
    }
}
