//! Tests of presses for contact shapes and for changes of pose.

use taceva_core::{GratingKind, Nanometre, Specimen};

use super::*;

/// Scene `text` with six presses of the ball for shapes and four pairs of presses of a board for changes of pose.
pub(super) fn with_both(text: &str) -> String {
    let both = "[protocol]\nshape = { presses = 6, depths = 2 }\npose = { pairs = 4, shift_mm = 0.5, turn_degrees = 12 }";
    let changed = text.replace("[protocol]", both);
    assert_ne!(changed, text);
    changed
}

fn planned_with(text: &str) -> Plan {
    let source = SourceInfo::Rig(Box::new(rig_of(sensor(), Axes::FORCE)));
    planned_as(text, source, &only(&["mae"]))
}

#[test]
fn a_shape_is_pressed_straight_to_increasing_depths_with_pictures() {
    let plan = planned_with(&with_both(SMALL));
    let presses: Vec<&PlannedPress> = plan.presses_of(PhaseKind::Shape).collect();
    assert_eq!(presses.len(), 6);
    for press in presses {
        let waypoints = press.press.waypoints();
        assert!(press.frames && waypoints.len() == 2);
        assert!(waypoints[0].depth < waypoints[1].depth);
        assert!(waypoints.iter().all(|one| one.shear == [Nanometre(0); 2]));
    }
    assert!(plan.reads_depth());
}

#[test]
fn a_pair_presses_one_board_at_two_places_and_turns_within_the_greatest_change() {
    let plan = planned_with(&with_both(SMALL));
    let presses: Vec<&PlannedPress> = plan.presses_of(PhaseKind::Pose).collect();
    let board = Specimen::Grating {
        kind: GratingKind::Dot,
        spacing: Nanometre(1_750_000),
    };
    let mut numbers = Vec::new();
    for press in presses {
        assert!(press.frames && press.press.specimen == board);
        assert!(press.press.place.iter().all(|side| side.0.abs() <= 250_000));
        assert!((0..=12_000).contains(&press.press.turn_millidegrees));
        numbers.extend(press.press.repeat);
    }
    assert_eq!(numbers, (0..8).collect::<Vec<u32>>());
}

#[test]
fn neither_is_planned_without_a_model_and_the_plan_has_the_reason() {
    let text = with_both(SMALL).replace("[model]\nname = \"ridge\"\n", "");
    let plan = planned_with(&text);
    for kind in [PhaseKind::Shape, PhaseKind::Pose] {
        assert!(!plan.phases.contains(&kind), "{plan}");
        assert_eq!(plan.presses_of(kind).count(), 0);
        let mut skipped = plan.skipped.iter();
        let skip = skipped.find(|skip| skip.subject == Subject::Phase(kind));
        let reason = skip.expect("a reason").reason.to_string();
        assert!(reason.contains("needs a model: none chosen"), "{reason}");
    }
}

#[test]
fn a_model_file_predicts_shapes_but_no_poses_of_a_board() {
    let text = with_both(SMALL).replace("name = \"ridge\"", "file = \"gel.model\"");
    let plan = planned_with(&text);
    assert!(plan.phases.contains(&PhaseKind::Shape), "{plan}");
    assert!(!plan.phases.contains(&PhaseKind::Pose), "{plan}");
    let mut skipped = plan.skipped.iter();
    let skip = skipped.find(|skip| skip.subject == Subject::Phase(PhaseKind::Pose));
    let reason = skip.expect("a reason").reason.to_string();
    let fitted = "needs a model that can be fitted";
    assert!(reason.contains(fitted), "{reason}");
}

#[test]
fn scores_of_tasks_take_their_phases_and_the_fit_that_they_need() {
    let slip = with_both(SMALL).replace("[protocol]", "[protocol]\nslip = { strokes = 3 }");
    let text = format!("{slip}[metrics]\nwant = [\"f1\", \"pose_axis\", \"contact_iou\"]\n");
    let scene = Scene::parse("small", &text).expect("a scene");
    let source = SourceInfo::Rig(Box::new(rig_of(sensor(), Axes::FORCE)));
    let plans = plan(&scene, |_| source.clone()).expect("a plan");
    let expected = [
        PhaseKind::Calibration,
        PhaseKind::Slip,
        PhaseKind::Shape,
        PhaseKind::Pose,
    ];
    assert_eq!(plans[0].phases, expected, "{}", plans[0]);
    assert!(plans[0].metrics.is_empty());
    assert!(plans[0].to_string().contains("add   metric  skill"));
    let fields: Vec<Field> = plans[0].fits.iter().map(|fit| fit.field).collect();
    assert_eq!(fields, [Field::Prediction]);
}
