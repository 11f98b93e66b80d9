//! Tests of strokes for the detection of slip.

use super::*;
use crate::press::Waypoint;

/// Plan of a small scene with ten strokes of 0.4 mm in steps of 0.1 mm.
fn with_strokes() -> Plan {
    let text = SMALL.replace(
        "[protocol]",
        "[protocol]\nslip = { strokes = 10, length_mm = 0.4 }",
    );
    assert_ne!(text, SMALL);
    planned_as(
        &text,
        SourceInfo::Rig(Box::new(rig_of(sensor(), Axes::FORCE))),
        &only(&["mae"]),
    )
}

#[test]
fn strokes_are_planned_with_pictures_although_no_metric_reads_them() {
    let plan = with_strokes();
    let strokes: Vec<&PlannedPress> = plan.presses_of(PhaseKind::Slip).collect();
    assert_eq!(strokes.len(), 10);
    assert!(strokes.iter().all(|press| press.frames));
    assert!(plan.fields.contains(Field::Truth) && plan.fields.contains(Field::Point));
    assert!(
        !planned(SMALL, rig_of(sensor(), Axes::FORCE))
            .phases
            .contains(&PhaseKind::Slip)
    );
}

#[test]
fn a_stroke_keeps_its_depth_and_advances_by_the_distance_of_two_frames() {
    let plan = with_strokes();
    for stroke in plan.presses_of(PhaseKind::Slip) {
        let waypoints = stroke.press.waypoints();
        assert_eq!(waypoints.len(), 5);
        let along = |waypoint: &Waypoint| {
            let [x, y] = waypoint.shear.map(|side| side.0.abs());
            x + y
        };
        let found: Vec<i64> = waypoints.iter().map(along).collect();
        assert_eq!(found, [0, 100_000, 200_000, 300_000, 400_000]);
        assert!(waypoints.iter().all(|one| one.depth == waypoints[0].depth));
    }
}
