//! Tests of the facts of a gel that a rig file states.

use super::*;

/// Rig file [`RIG`] with facts of the gel added to the table `[sensor]`, from line 14 on.
fn rig_with_gel() -> String {
    let gel = "opaque = true\nmarkers = false\nfootprint = { shape = \"rect\", half_x_mm = 8.0, half_y_mm = 10.0 }\n";
    RIG.replacen(
        "latency_ms = 38.0\n",
        &format!("latency_ms = 38.0\n{gel}"),
        1,
    )
}

#[test]
fn a_rig_file_may_state_the_gel_and_the_scene_then_needs_no_sensor() {
    let plan_of = |scene: &str, rig: &str| {
        let devices = devices();
        let plans = plan(&put_on(scene, rig), |_| {
            SourceInfo::Rig(Box::new(devices.clone()))
        });
        plans.expect("plans").remove(0)
    };
    let (bare, _) = SCENE.split_once("[sensor]").expect("a sensor");
    let by_rig = plan_of(bare, &rig_with_gel());
    assert_eq!(by_rig.opaque, Some(true));
    assert_eq!(by_rig.footprint, plan_of(SCENE, RIG).footprint);
    assert!(!by_rig.presses.is_empty());
    // Without a footprint in either file nothing is pressed.
    assert!(plan_of(bare, RIG).presses.is_empty());
    // A scene may press a smaller surface.
    let smaller = SCENE.replace("half_y_mm = 10.0", "half_y_mm = 6.0");
    let smaller = plan_of(&smaller, &rig_with_gel());
    assert_ne!(smaller.footprint, by_rig.footprint);
}

#[test]
fn facts_of_the_gel_that_scene_and_rig_file_contradict_are_refused_with_both_lines() {
    let rig = rig_with_gel();
    let clear = SCENE.replace("opaque = true", "opaque = false");
    assert_eq!(
        planned_on(&clear, &rig).expect_err("clear or opaque"),
        "s.toml, line 6: `opaque` is false, but lab.toml, line 14 states true: correct one of them"
    );
    let marked = SCENE.replace("opaque = true", "markers = true");
    assert_eq!(
        planned_on(&marked, &rig).expect_err("with markers or without"),
        "s.toml, line 6: `markers` is true, but lab.toml, line 15 states false: correct one of them"
    );
    let larger = SCENE.replace("half_y_mm = 10.0", "half_y_mm = 12.0");
    let said = planned_on(&larger, &rig).expect_err("beyond the gel");
    assert!(
        said.starts_with("s.toml, line 7: the footprint extends 8 mm by 12 mm from its centre, but lab.toml, line 16 allows at most 8 mm by 10 mm"),
        "{said}"
    );
    let empty = refused(
        "latency_ms = 38.0",
        "latency_ms = 38.0\nfootprint = { shape = \"disc\" }",
    );
    assert_eq!(
        empty,
        "lab.toml, line 14: a disc has `radius_mm` and no other length"
    );
}
