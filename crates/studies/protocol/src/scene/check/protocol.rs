//! Checks of the counts and lengths of a protocol.

use super::{Check, Checked};
use crate::scene::boards;
use crate::scene::counts::{PosePairs, Protocol, ShapePresses};
use crate::scene::metrics::MetricsSpec;
use crate::scene::task_metrics::{missing_line, phase_of_task};

/// Greatest accepted count in a scene, such as a number of points or presses.
pub(super) const GREATEST_COUNT: u64 = 1_000_000;
/// Least accepted side of a pixel of a depth map, in mm.
const LEAST_PIXEL_MM: f64 = 0.05;
/// Greatest accepted side of a pixel of a depth map, in mm.
const GREATEST_PIXEL_MM: f64 = 5.0;

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
            shape,
            pose,
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
        if calibration.points_max.at().is_some() {
            let least = u64::from(calibration.points.value);
            self.count("points_max", &calibration.points_max, least, GREATEST_COUNT)?;
        }
        self.count("indentations", &calibration.indentations, 1, 1_000)?;
        // A single trial repeats nothing, and a single frame has no rate.
        self.count("trials", &repeatability.trials, 2, GREATEST_COUNT)?;
        self.count("frames", &idle.frames, 2, GREATEST_COUNT)?;
        self.count("strokes", &slip.strokes, 0, GREATEST_COUNT)?;
        self.count("window", &slip.window, 1, 64)?;
        self.count("presses", &shape.presses, 0, GREATEST_COUNT)?;
        self.count("depths", &shape.depths, 1, 1_000)?;
        self.count("pairs", &pose.pairs, 0, GREATEST_COUNT)?;
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
            ("depth_min_mm", &shape.depth_min_mm),
            ("shift_mm", &pose.shift_mm),
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
        self.shape(shape)?;
        self.pose(pose)?;
        self.wear(wear.as_ref())?;
        boards::spacings(gratings)
            .map(drop)
            .map_err(|refused| self.text.error(refused.at, refused.problem))
    }

    fn shape(&self, shape: &ShapePresses) -> Checked {
        let pixel = &shape.pixel_mm;
        if pixel.value < LEAST_PIXEL_MM {
            let problem = format!(
                "`pixel_mm` is {}, expected a number from {LEAST_PIXEL_MM} to {GREATEST_PIXEL_MM}",
                pixel.value
            );
            return self.contradiction(pixel.at(), &problem);
        }
        self.range("pixel_mm", pixel, GREATEST_PIXEL_MM)
    }

    fn pose(&self, pose: &PosePairs) -> Checked {
        self.range("depth_fraction", &pose.depth_fraction, 1.0)?;
        // A board of dots looks the same after a quarter of a turn.
        self.range("turn_degrees", &pose.turn_degrees, 90.0)?;
        boards::spacing_of(&pose.spacing_mm)
            .map_err(|refused| self.text.error(refused.at, refused.problem))?;
        let (shift, spacing) = (&pose.shift_mm, pose.spacing_mm.value);
        if shift.value < spacing {
            return Ok(());
        }
        let problem = format!(
            "`shift_mm` is {}, but a board with `spacing_mm` = {spacing} looks the same after {spacing} mm: expected a number below {spacing}",
            shift.value
        );
        self.contradiction(shift.at(), &problem)
    }

    /// Rejects a requested score of a task whose presses the protocol does not request.
    pub(super) fn tasks(&self, metrics: &MetricsSpec, protocol: &Protocol) -> Checked {
        for name in metrics.want.iter().flatten() {
            let phase = phase_of_task(&name.value);
            if let Some((phase, line)) =
                phase.and_then(|phase| Some((phase, missing_line(phase, protocol)?)))
            {
                let problem = format!(
                    "`{}` needs presses of the phase {phase}, and the scene has none: write `{line}` under [protocol]",
                    name.value
                );
                return self.contradiction(name.at(), &problem);
            }
        }
        Ok(())
    }
}
