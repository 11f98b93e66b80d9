//! Tests of scenes that contradict their devices.

use taceva_core::{Descriptor, Facts, FrameInfo, LightingFacts, Newton, PixelFormat, SensorFacts};
use taceva_protocol::{Plan, RigInfo, Scene, SceneProblem, SourceInfo, plan};

use super::{GOOD, descriptor, planned, rig, with};

#[test]
fn a_scene_may_not_loosen_the_limits_of_a_device() {
    assert_eq!(
        planned("[limits]\nFz_max_N = 2.0", rig()),
        "s.toml, line 10: `Fz_max_N` is 2, but the sensor `sim/gelsight` allows at most 1.83: limits may only be tightened"
    );
    assert_eq!(
        planned("[limits]\nPz_max_mm = 1.5", rig()),
        "s.toml, line 10: `Pz_max_mm` is 1.5, but the sensor `sim/gelsight` allows at most 1: limits may only be tightened"
    );
    assert!(
        planned("[limits]\nspeed_max_mm_s = 500.0", rig())
            .contains("the robot `sim/robot` allows at most 100")
    );
}

#[test]
fn limits_that_tighten_are_taken() {
    let plan = planned("[limits]\nFz_max_N = 1.5\nPz_max_mm = 0.8", rig());
    assert!(plan.contains("limit motion  0.8 mm, 1.5 N"), "{plan}");
}

#[test]
fn a_robot_is_not_moved_without_limits() {
    let mut bare = rig();
    bare.sensor = Some(descriptor("sim/gelsight", Facts::Sensor(Box::default())));
    assert_eq!(
        planned("", bare),
        "s.toml: the limit `Pz_max_mm` is missing: write it under [limits]; no robot moves without it"
    );
}

#[test]
fn a_depth_beyond_the_limit_is_refused_with_line_and_limit() {
    let error = planned("[protocol.calibration]\ndepth_min_mm = 1.2", rig());
    assert_eq!(
        error,
        "s.toml, line 10: `depth_min_mm` is 1.2, beyond the limit `Pz_max_mm` = 1 (study `my gel`)"
    );
    let error = planned("[protocol.hysteresis]\ndepth_step_mm = 1.2", rig());
    assert_eq!(
        error,
        "s.toml, line 10: `depth_step_mm` is 1.2, beyond the limit `Pz_max_mm` = 1 (study `my gel`)"
    );
}

#[test]
fn a_force_beyond_the_limit_is_refused_with_line_and_limit() {
    let error = planned("[protocol.contact]\nthreshold_N = 1.9", rig());
    assert_eq!(
        error,
        "s.toml, line 10: `threshold_N` is 1.9, beyond the limit `Fz_max_N` = 1.83 (study `my gel`)"
    );
    let error = planned("[limits]\nFxy_max_N = 6.0", rig());
    assert_eq!(
        error,
        "s.toml, line 10: `Fxy_max_N` is 6, but the force transducer `sim/force-transducer` allows at most 5: limits may only be tightened"
    );
}

#[test]
fn a_speed_beyond_the_limit_is_refused_with_line_and_limit() {
    let error = planned("[protocol.contact]\ntravel_mm_s = 200.0", rig());
    assert_eq!(
        error,
        "s.toml, line 10: `travel_mm_s` is 200, beyond the limit `speed_max_mm_s` = 100 (the robot `sim/robot`)"
    );
}

#[test]
fn a_gel_that_is_opaque_and_said_to_be_transparent_is_refused() {
    let text = GOOD.replace("[robot]", "opaque = false\n[robot]");
    let scene = Scene::parse("s.toml", &text).expect("reads");
    let error = plan(&scene, |_| SourceInfo::Rig(Box::new(rig()))).expect_err("contradiction");
    assert_eq!(
        error.to_string(),
        "s.toml, line 5: `opaque` is false, but the sensor states true: correct one of them"
    );
}

#[test]
fn a_footprint_beyond_that_of_the_sensor_is_refused_with_line_and_limit() {
    let wide = "footprint = { shape = \"rect\", half_x_mm = 9.0, half_y_mm = 10.0 }\n[robot]";
    let scene = Scene::parse("s.toml", &GOOD.replace("[robot]", wide)).expect("reads");
    let error = plan(&scene, |_| SourceInfo::Rig(Box::new(rig()))).expect_err("too wide");
    assert_eq!(
        error.to_string(),
        "s.toml, line 5: the footprint extends 9 mm by 10 mm from its centre, but the sensor allows at most 8 mm by 10 mm: state a smaller footprint"
    );
}

#[test]
fn a_light_that_nobody_can_set_is_refused() {
    let mut lit = rig();
    lit.lighting = Some(descriptor(
        "sim/lighting",
        Facts::Lighting(LightingFacts::default().with_scenes(vec!["normal".into(), "ring".into()])),
    ));
    let lines = "[lighting]\ndriver = \"sim/lighting\"\nscenes = [\"normal\", \"rnig\"]";
    let error = planned(lines, lit);
    assert!(
        error.starts_with("s.toml, line 11: `rnig`: unknown scene of light, did you mean `ring`?"),
        "{error}"
    );
    let twice = with("[lighting]\ndriver = \"sim/lighting\"\nscenes = [\"a\", \"a\"]");
    assert!(
        twice.contains("`a` is the name of two scenes of light"),
        "{twice}"
    );
}

#[test]
fn a_light_without_a_driver_is_set_by_hand_on_real_rigs_alone() {
    let error = planned("[lighting]\nscenes = [\"dark\", \"lamp\"]", rig());
    assert!(error.starts_with("s.toml, line 10: "), "{error}");
    assert!(
        error.contains("set by hand, which needs a real robot"),
        "{error}"
    );
    let nothing = with("[lighting]");
    assert!(
        nothing.contains("expected [lighting] with `driver`"),
        "{nothing}"
    );
}

#[test]
fn a_metric_that_can_never_apply_is_refused_by_its_line_if_it_was_named_by_itself() {
    let error = planned("[metrics]\nwant = [\"mae\"]", rig());
    assert_eq!(
        error,
        "s.toml, line 10: `mae` can never apply: needs `prediction` ← needs a model: none chosen"
    );
    let error = planned(
        "[model]\nname = \"ridge\"\n[metrics]\nwant = [\"r_light\"]",
        rig(),
    );
    assert_eq!(
        error,
        "s.toml, line 12: `r_light` can never apply: the gel is opaque: ambient light cannot reach the camera"
    );
    // A group includes only the metrics that apply.
    let explained = planned("[metrics]\nwant = [\"accuracy\"]", rig());
    assert!(
        explained.contains("skip  metric  mae, r2, smape"),
        "{explained}"
    );
}

#[test]
fn bad_settings_of_tasks_are_refused_with_what_is_expected() {
    for (line, said) in [
        ("[protocol.shape]\npress = 3", "`press`: unknown key"),
        ("[protocol.shape]\npixel_mm = 0.01", "from 0.05 to 5"),
        ("[protocol.shape]\ndepths = 0", "`depths` is 0"),
        (
            "[protocol.pose]\nshift_mm = 2.0",
            "expected a number below 1.75",
        ),
        (
            "[protocol.pose]\nspacing_mm = 0.33",
            "gratings of 0.33 mm are not in the catalogue",
        ),
        (
            "[protocol.pose]\nturn_degrees = 91.0",
            "`turn_degrees` is 91",
        ),
        ("[protocol.pose]\nkind = \"ball\"", "`line`"),
        (
            "[metrics]\nwant = [\"depth_rms\"]",
            "did you mean `depth_rmse`?",
        ),
    ] {
        let error = with(line);
        assert!(error.contains(said), "{line}: {error}");
    }
}

#[test]
fn a_score_of_a_task_needs_presses_of_the_scene_and_a_surface() {
    let error = with("[metrics]\nwant = [\"f1\"]");
    assert_eq!(
        error,
        "s.toml, line 10: `f1` needs presses of the phase slip, and the scene has none: write `slip = { strokes = 40 }` under [protocol]"
    );
    let lines = "[protocol.slip]\nstrokes = 3\n[metrics]\nwant = [\"f1\"]";
    let mut unknown = rig();
    unknown.sensor = Some(descriptor(
        "sim/gelsight",
        Facts::Sensor(Box::new(
            SensorFacts::default().with_force_max(Newton(1.83)),
        )),
    ));
    let limited = format!("[limits]\nPz_max_mm = 1.0\n{lines}");
    let error = planned(&limited, unknown);
    assert!(
        error.contains("`f1` can never apply: the sensor's `footprint`"),
        "{error}"
    );
}

#[test]
fn more_presses_than_any_gel_survives_are_refused() {
    let scene = format!(
        "{GOOD}[model]\nname = \"ridge\"\n[protocol.calibration]\npoints = 1000000\n[protocol.spatial]\npoints = 1000000\n"
    );
    let scene = Scene::parse("s.toml", &scene).expect("reads");
    let source = SourceInfo::Rig(Box::new(rig()));
    // Presses are counted before they are drawn.
    match plan(&scene, |_| source.clone())
        .err()
        .map(|error| *error.problem)
    {
        Some(SceneProblem::TooManyPresses { found, .. }) => assert!(found > 1_000_000),
        other => panic!("{}", other.is_none()),
    }
}

/// Test rig whose sensor states the size of its frames.
fn seeing() -> RigInfo {
    let info = FrameInfo {
        width: 160,
        height: 120,
        format: PixelFormat::Rgb16,
    };
    let seen = rig();
    let sensor = seen.sensor.as_ref().and_then(Descriptor::sensor);
    let facts = sensor.expect("a sensor").clone().with_frame(Some(info));
    RigInfo {
        sensor: Some(descriptor("sim/gelsight", Facts::Sensor(Box::new(facts)))),
        ..seen
    }
}

#[test]
fn frames_larger_than_those_of_the_sensor_are_refused_with_line_and_size() {
    for size in ["161x120", "160x121"] {
        let error = planned(&format!("[recording]\nframes = \"{size}\""), seeing());
        assert_eq!(
            error,
            format!(
                "s.toml, line 10: `frames` is `{size}`, but the frames of study `my gel` are 160×120 rgb16: expected at most `160x120`, since frames can only be reduced"
            )
        );
    }
    let plan = planned("[recording]\nframes = \"160x120\"", seeing());
    assert!(plan.starts_with("plan  study   my gel"), "{plan}");
}

#[test]
fn a_plan_says_at_what_size_frames_are_kept_and_costs_what_they_take() {
    let planned = |more: &str| {
        let text = GOOD.replacen("[sensor]", &format!("{more}\n[sensor]"), 1);
        let text =
            format!("{text}[model]\nname = \"ridge\"\n[protocol.calibration]\npoints = 10\n");
        let scene = Scene::parse("s.toml", &text).expect("reads");
        let source = SourceInfo::Rig(Box::new(seeing()));
        plan(&scene, |_| source.clone()).expect("a plan").remove(0)
    };
    let (whole, kept) = (planned(""), planned("recording = { frames = \"64x48\" }"));
    assert!(
        kept.to_string()
            .contains("keep  frames  64x48 in 8 bits, area averages of 160×120 rgb16"),
        "{kept}"
    );
    assert!(!whole.to_string().contains("keep  frames"), "{whole}");
    let bytes = |plan: &Plan, frame: u64| plan.cost.frames * frame;
    assert!(whole.cost.frames > 0);
    assert_eq!(whole.cost.bytes, Some(bytes(&whole, 160 * 120 * 6)));
    assert_eq!(kept.cost.bytes, Some(bytes(&kept, 64 * 48 * 3)));
    // The recording is another one; the camera stays the same.
    assert_ne!(whole.digest(), kept.digest());
    assert_eq!(whole.frame, kept.frame);
    let written = |plan: &Plan| serde_json::to_value(plan).expect("JSON");
    assert!(written(&whole).get("kept_frames").is_none());
    assert_eq!(written(&kept)["kept_frames"]["width"], 64);
}

#[test]
fn depths_from_another_origin_are_another_recording_of_the_same_presses() {
    let planned = |more: &str| {
        let scene = Scene::parse("s.toml", &format!("{GOOD}{more}\n")).expect("reads");
        let source = SourceInfo::Rig(Box::new(seeing()));
        plan(&scene, |_| source.clone()).expect("a plan").remove(0)
    };
    let surface = planned("[protocol.contact]\ndepth_from = \"surface\"");
    let contact = planned("[protocol.contact]\ndepth_from = \"contact\"");
    assert_eq!(planned("").digest(), contact.digest());
    assert_ne!(contact.digest(), surface.digest());
    assert_eq!(contact.presses, surface.presses);
}
