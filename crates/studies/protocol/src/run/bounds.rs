//! Workspace of the tip. The workspace is a convex box, so a straight line between two places inside stays inside.

use taceva_core::{Footprint, Nanometre, Pose};

use super::error::StopCause;
use crate::plan::Plan;

/// Places that the tip may reach during a plan: a box in the sensor frame, in mm.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    half_x: f64,
    half_y: f64,
    highest: f64,
    deepest: f64,
}

/// Tolerance for rounding errors in the sum of a few lengths, in mm.
const ROUNDING_MM: f64 = 1e-9;

impl Bounds {
    /// Workspace of `plan`. Sideways, the footprint plus the greatest shear. Upwards, `height_mm` above the clearance. Downwards, the greatest depth
    /// below the lowest surface of the search. `None` if the plan moves nothing.
    pub(super) fn of(plan: &Plan, height_mm: f64) -> Option<Bounds> {
        let [half_x, half_y] = plan.footprint.as_ref().map(Footprint::half_extent)?;
        let shear = plan
            .presses
            .iter()
            .flat_map(|press| press.press.waypoints());
        let shear = shear.flat_map(|waypoint| waypoint.shear);
        let shear = shear.map(|shear| shear.0.abs()).max().unwrap_or(0);
        let limits = plan.limits.as_ref()?;
        // A motion starts at the reported pose, which can be outside because of noise.
        let slack_mm = ROUNDING_MM + limits.signals.slack_mm();
        let side = |half: Nanometre| Nanometre(half.0 + shear).to_millimetres() + slack_mm;
        Some(Bounds {
            half_x: side(half_x),
            half_y: side(half_y),
            highest: -plan.contact.clearance_mm.value - height_mm - slack_mm,
            deepest: plan.contact.search_mm.value + limits.depth_max.0 + slack_mm,
        })
    }

    /// Rejects a `target` outside the workspace.
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

#[cfg(test)]
mod tests {
    use taceva_core::{Axes, Millimetre, Phase, Point};

    use super::*;
    use crate::plan::plan_study;
    use crate::plan::tests::bench::{SMALL, paper_metrics, rig_of, sensor};
    use crate::press::{Motion, Waypoint};
    use crate::scene::Scene;
    use crate::source::SourceInfo;

    /// Plan on a footprint with half extents of 8 mm and 10 mm, and shears of up to 0.25 mm. Clearance is 2 mm, search 0.5 mm, greatest depth 1 mm.
    fn plan() -> Plan {
        let scene = Scene::parse("small", SMALL).expect("a scene");
        let source = SourceInfo::Rig(Box::new(rig_of(sensor(), Axes::FORCE)));
        let plan = plan_study(&scene, &scene.studies[0], &source, &paper_metrics());
        let mut plan = plan.expect("a plan");
        plan.footprint = Some(Footprint::rectangle(8.0, 10.0, None).expect("lengths"));
        plan.contact.clearance_mm.value = 2.0;
        plan.contact.search_mm.value = 0.5;
        plan.limits.as_mut().expect("it moves").depth_max = Millimetre(1.0);
        plan.presses.truncate(1);
        let sheared = |shear| Waypoint {
            depth: Nanometre(500_000),
            shear,
            phase: Phase::Load,
        };
        let waypoints = [
            [Nanometre(125_000), Nanometre(0)],
            [Nanometre(0), Nanometre(-250_000)],
        ];
        plan.presses[0].press.motion = Motion::Indent(waypoints.map(sheared).to_vec());
        plan
    }

    fn is_admitted(bounds: &Bounds, [x, y, z]: [f64; 3]) -> bool {
        let [x, y, z] = [x, y, z].map(Millimetre);
        let pose = Pose {
            position: Point { x, y, z },
            ..Pose::default()
        };
        bounds.admit(&pose).is_ok()
    }

    #[test]
    fn each_side_of_the_workspace_is_admitted_and_nothing_a_thousandth_of_a_micrometre_beyond_it() {
        let bounds = Bounds::of(&plan(), 0.75).expect("it moves");
        // The greatest shear counts along both axes; z points into the gel.
        for (axis, least, greatest) in [(0, -8.25, 8.25), (1, -10.25, 10.25), (2, -2.75, 1.5)] {
            let at = |value: f64| {
                let mut place = [0.0; 3];
                place[axis] = value;
                is_admitted(&bounds, place)
            };
            assert!(at(least) && at(greatest), "axis {axis}");
            assert!(!at(least - 1e-6), "axis {axis}");
            assert!(!at(greatest + 1e-6), "axis {axis}");
        }
        assert!(is_admitted(&bounds, [8.25, -10.25, 1.5]));
    }

    #[test]
    fn no_bound_refuses_the_lift_that_was_asked_for_and_each_refuses_more() {
        // A run in the air asks for 10 mm above the clearance of 2 mm.
        for (lift_mm, highest_mm) in [(0.0, -2.0), (10.0, -12.0)] {
            let bounds = Bounds::of(&plan(), lift_mm).expect("it moves");
            assert!(is_admitted(&bounds, [0.0, 0.0, highest_mm]), "{lift_mm}");
            let beyond = [0.0, 0.0, highest_mm - 1e-6];
            assert!(!is_admitted(&bounds, beyond), "{lift_mm}");
        }
    }

    #[test]
    fn what_lies_outside_along_two_axes_is_refused_with_its_place() {
        let bounds = Bounds::of(&plan(), 0.0).expect("it moves");
        for (x, y, z) in [(9.0, 11.0, 0.0), (9.0, 0.0, 2.0), (0.0, 11.0, -9.0)] {
            let pose = Pose {
                position: Point {
                    x: Millimetre(x),
                    y: Millimetre(y),
                    z: Millimetre(z),
                },
                ..Pose::default()
            };
            let cause = bounds.admit(&pose).expect_err("outside");
            let place = format!("({x:.3}, {y:.3}, {z:.3}) mm");
            assert!(matches!(&cause, StopCause::Workspace { place: at } if *at == place));
        }
    }

    #[test]
    fn a_plan_without_shears_ends_at_the_footprint() {
        let mut plan = plan();
        plan.presses[0].press.motion = Motion::Touch;
        let bounds = Bounds::of(&plan, 0.0).expect("it moves");
        assert!(is_admitted(&bounds, [8.0, 10.0, -2.0]));
        assert!(!is_admitted(&bounds, [8.000_001, 0.0, 0.0]));
        assert!(!is_admitted(&bounds, [0.0, 10.000_001, 0.0]));
    }
}
