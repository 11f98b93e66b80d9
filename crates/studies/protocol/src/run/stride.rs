//! Length of one motion near or in the gel.
//!
//! Without guard threads, a run detects a limit only at the end of a motion, so motions are segments of 15 ms. Guard threads halt within a motion, so
//! a motion may be longer, but ends before a limit is expected. The stated overshoot therefore holds even if a guard halts late.

use taceva_core::Pose;

use super::supervisor::MotionStage;
use super::tip::Tip;
use super::way::{is_straight_down, is_straight_up};

/// Longest motion near the gel, in mm. A robot that has lost its host travels no farther.
const LONGEST_MM: f64 = 1.0;
impl Tip<'_> {
    /// Length of the next motion from `here` towards `goal`, in mm.
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
                // The stiffness counts from the first contact. A surface that was fitted too high would make the gel seem too soft.
                let z_mm = here.position.z.0;
                let contact_mm = self.contact_mm.unwrap_or(height_mm);
                let room_mm = bearing.room_mm(z_mm - contact_mm, &self.felt);
                room_mm.min(bearing.depth_max_mm - (z_mm - height_mm))
            }
            _ => segment_mm,
        };
        stride_mm.clamp(segment_mm, LONGEST_MM.max(segment_mm))
    }
}
