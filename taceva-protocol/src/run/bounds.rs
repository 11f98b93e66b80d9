//! Where the tip may be sent. The box is convex, so a straight line between two places in it stays in it.

use taceva_core::{Footprint, Nanometre, Pose};

use super::error::StopCause;
use crate::plan::Plan;

/// The workspace of a plan, in mm of the sensor's frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    half_x: f64,
    half_y: f64,
    highest: f64,
    deepest: f64,
}

/// What binary64 makes of sums of a few lengths.
const ROUNDING_MM: f64 = 1e-9;

impl Bounds {
    /// Over the surface and the shears of `plan`, from `height_mm` above the clearance down to the end of the search.
    pub(super) fn of(plan: &Plan, height_mm: f64) -> Option<Bounds> {
        let [half_x, half_y] = plan.footprint.as_ref().map(Footprint::half_extent)?;
        let shear = plan.presses.iter().flat_map(|press| press.press.stations());
        let shear = shear.flat_map(|station| station.shear);
        let shear = shear.map(|shear| shear.0.abs()).max().unwrap_or(0);
        let side = |half: Nanometre| Nanometre(half.0 + shear).to_millimetres() + ROUNDING_MM;
        let limits = plan.limits.as_ref()?;
        Some(Bounds {
            half_x: side(half_x),
            half_y: side(half_y),
            highest: -plan.contact.clearance_mm.value - height_mm - ROUNDING_MM,
            deepest: plan.contact.search_mm.value + limits.depth_max.0 + ROUNDING_MM,
        })
    }

    /// Lets `target` through.
    pub(super) fn admit(&self, target: &Pose) -> Result<(), StopCause> {
        let [x, y, z] = [
            target.position.x.0,
            target.position.y.0,
            target.position.z.0,
        ];
        let inside = x.abs() <= self.half_x
            && y.abs() <= self.half_y
            && (self.highest..=self.deepest).contains(&z);
        if inside {
            return Ok(());
        }
        Err(StopCause::Workspace {
            place: format!("({x:.3}, {y:.3}, {z:.3}) mm"),
        })
    }
}
