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
            MotionStage::Press { height_mm } => {
                bearing.room_mm(here.position.z.0 - height_mm, &self.felt)
            }
            _ => segment_mm,
        };
        stride_mm.clamp(segment_mm, LONGEST_MM.max(segment_mm))
    }
}
