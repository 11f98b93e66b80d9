//! Checks of the counts and lengths of a protocol.

use super::{Check, Checked};
use crate::scene::boards;
use crate::scene::counts::Protocol;

/// Greatest count in a scene.
pub(super) const GREATEST_COUNT: u64 = 1_000_000;

impl Check<'_> {
    pub(super) fn protocol(&self, protocol: &Protocol) -> Checked {
        let Protocol {
            contact,
            calibration,
            spatial,
            gratings,
            lighting,
            repeatability,
            hysteresis,
            surface,
            idle,
            slip,
            wear,
        } = protocol;
        for (key, count) in [
            ("points", &calibration.points),
            ("points", &spatial.points),
            ("presses", &gratings.presses),
            ("points", &lighting.points),
            ("points", &repeatability.points),
            ("points", &hysteresis.points),
            ("points", &surface.points),
            ("frames", &idle.frames),
        ] {
            self.count(key, count, 1, GREATEST_COUNT)?;
        }
        self.count("indentations", &calibration.indentations, 1, 1_000)?;
        // A single trial repeats nothing, and a single frame has no rate.
        self.count("trials", &repeatability.trials, 2, GREATEST_COUNT)?;
        self.count("frames", &idle.frames, 2, GREATEST_COUNT)?;
        self.count("strokes", &slip.strokes, 0, GREATEST_COUNT)?;
        self.count("window", &slip.window, 1, 64)?;
        for (key, length) in [
            ("indenter_radius_mm", &contact.indenter_radius_mm),
            ("step_mm", &contact.step_mm),
            ("threshold_N", &contact.threshold_n),
            ("clearance_mm", &contact.clearance_mm),
            ("search_mm", &contact.search_mm),
            ("travel_mm_s", &contact.travel_mm_s),
            ("depth_min_mm", &calibration.depth_min_mm),
            ("depth_min_mm", &spatial.depth_min_mm),
            ("depth_step_mm", &repeatability.depth_step_mm),
            ("depth_step_mm", &hysteresis.depth_step_mm),
            ("speed_mm_s", &slip.speed_mm_s),
            ("rate_hz", &slip.rate_hz),
            ("length_mm", &slip.length_mm),
            ("depth_mm", &slip.depth_mm),
        ] {
            self.length(key, length)?;
        }
        for shear in [
            &calibration.shear_mm,
            &spatial.shear_mm,
            &repeatability.shear_mm,
        ] {
            if shear.value != 0.0 {
                self.length("shear_mm", shear)?;
            }
        }
        self.range("settle_s", &contact.settle_s, 10.0)?;
        self.range("step_mm", &contact.step_mm, 0.5)?;
        // In contact, the tip must be able to stop within a step.
        self.range("speed_mm_s", &contact.speed_mm_s, 5.0)?;
        self.range("depth_fraction", &gratings.depth_fraction, 1.0)?;
        self.range("friction", &slip.friction, 5.0)?;
        self.wear(wear.as_ref())?;
        boards::spacings(gratings)
            .map(drop)
            .map_err(|refused| self.text.error(refused.at, refused.problem))
    }
}
