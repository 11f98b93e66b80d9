//! Tests of `[protocol.wear]`: stages, cycles, presses on the gel, and wrong values.

use taceva_core::{Axes, Facts, ForceFacts};
use taceva_protocol::{Plan, RigInfo, Scene, SourceInfo, WearLoad, plan};

use super::{GOOD, descriptor, message, planned, rig, with};

/// Valid scene with stages of wear, set by `lines` of the table `[protocol.wear]`.
fn worn(lines: &str) -> String {
    format!("{GOOD}[protocol.wear]\n{lines}\n")
}

fn plans(lines: &str) -> Vec<Plan> {
    let text = worn(&format!(
        "{lines}\n[protocol.calibration]\npoints = 5\n[metrics]\nwant = [\"sensitivity\"]"
    ));
    let scene = Scene::parse("s.toml", &text).expect("reads");
    plan(&scene, |_| SourceInfo::Rig(Box::new(rig()))).expect("a plan")
}

const COMPRESSION: &str = "load = \"compression\"\ncycles = [0, 3, 10]\nforce_N = 1.0";

#[test]
fn each_stage_is_a_study_with_the_cycles_since_the_stage_before() {
    let plans = plans(COMPRESSION);
    let names: Vec<&str> = plans.iter().map(|plan| plan.name.as_str()).collect();
    let expected = [0, 3, 10].map(|cycles| format!("my gel after {cycles} cycles"));
    assert_eq!(names, expected);
    for (plan, cycles) in plans.iter().zip([0, 3, 7]) {
        let is_load = |press: &&taceva_protocol::PlannedPress| press.press.load().is_some();
        let loads = plan.presses.iter().take_while(is_load).count();
        assert_eq!((loads, plan.presses.len()), (cycles, cycles + 5));
        assert_eq!(plan.cost.presses, plan.presses.len() as u64);
        let measured = &plan.presses[loads..];
        assert_eq!(measured, &plans[0].presses[..], "the same presses");
    }
}

#[test]
fn presses_on_the_gel_are_those_before_the_run_the_cycles_and_the_measured_ones() {
    let counts = |lines: &str| -> Vec<u32> {
        let plans = plans(lines);
        let worn = plans.iter().flat_map(|plan| &plan.wear);
        worn.map(|wear| wear.presses_since_gel).collect()
    };
    assert_eq!(counts(COMPRESSION), [0, 3 + 5, 10 + 2 * 5]);
    let used = format!("{COMPRESSION}\npresses_since_gel = 200");
    assert_eq!(counts(&used), [200, 208, 220]);
}

#[test]
fn a_plan_states_cycles_force_hours_and_presses_of_a_stage() {
    let text = planned(
        "[protocol.wear]\nload = \"shear\"\ncycles = [2000]\nforce_N = 1\ntravel_mm = 0.5",
        rig(),
    );
    let line = text
        .lines()
        .find(|line| line.starts_with("load  gel"))
        .expect("a line");
    assert!(
        line.contains("2000 cycles of shear to 1 N over 0.5 mm, ~"),
        "{line}"
    );
    assert!(
        line.ends_with(" h; 2000 presses before the measured ones"),
        "{line}"
    );
    let plans = plans("load = \"shear\"\ncycles = [2000]\nforce_N = 1\ntravel_mm = 0.5");
    let wear = plans[0].wear.as_ref().expect("a stage");
    // A cycle takes 2 to 20 s.
    assert!((4_000.0..40_000.0).contains(&(60.0 * wear.minutes)));
    assert!(plans[0].cost.minutes > wear.minutes);
}

#[test]
fn a_stage_is_another_acquisition_and_a_scene_without_wear_is_the_same_as_before() {
    let plans = plans(COMPRESSION);
    assert_ne!(plans[1].digest(), plans[2].digest());
    let json = serde_json::to_value(&plans[1]).expect("a plan is data");
    assert_eq!(json["wear"]["presses_since_gel"], 8);
    assert_eq!(json["wear"]["sensor"], "my gel");
    let scene = Scene::parse("s.toml", GOOD).expect("reads");
    let source = || SourceInfo::Rig(Box::new(rig()));
    let plain = plan(&scene, |_| source()).expect("a plan");
    let json = serde_json::to_value(&plain[0]).expect("a plan is data");
    assert!(json.get("wear").is_none() && plain[0].wear.is_none());
}

#[test]
fn an_unknown_load_names_its_line_and_the_nearest_load() {
    let error = message(&worn(
        "load = \"compresion\"\ncycles = [0, 10]\nforce_N = 1.0",
    ));
    assert_eq!(
        error,
        "s.toml, line 10: `compresion`: unknown load, did you mean `compression`?; known: compression, shear, abrasion"
    );
    assert_eq!(WearLoad::from_name("compresion"), None);
}

#[test]
fn cycles_ascend_and_are_not_empty() {
    let error = message(&worn(
        "load = \"compression\"\ncycles = [0, 100, 100]\nforce_N = 1.0",
    ));
    assert_eq!(
        error,
        "s.toml, line 11: `cycles` has 100 after 100: expected ascending numbers, such as [0, 100, 1000]"
    );
    let error = message(&worn("load = \"compression\"\ncycles = []\nforce_N = 1.0"));
    assert!(
        error.starts_with("s.toml, line 11: `cycles` is empty"),
        "{error}"
    );
    let error = message(&worn(
        "load = \"compression\"\ncycles = [2000000]\nforce_N = 1.0",
    ));
    assert!(
        error.contains("`cycles` is 2000000, expected a whole number from 0 to 1000000"),
        "{error}"
    );
}

#[test]
fn a_load_needs_a_force_within_the_limit_of_the_gel() {
    let error = message(&worn("load = \"compression\"\ncycles = [0, 10]"));
    assert!(error.contains("the key `force_N` is missing"), "{error}");
    let error = message(&worn(
        "load = \"compression\"\ncycles = [0, 10]\nforce_N = 0.0",
    ));
    assert!(
        error.starts_with("s.toml, line 12: `force_N` is 0"),
        "{error}"
    );
    let lines = "[protocol.wear]\nload = \"compression\"\ncycles = [0, 10]\nforce_N = 2.5";
    assert_eq!(
        planned(lines, rig()),
        "s.toml, line 12: `force_N` is 2.5, beyond the limit `Fz_max_N` = 1.83 (study `my gel after 0 cycles`)"
    );
}

#[test]
fn a_travel_is_given_to_loads_that_have_one_and_stays_on_the_sensing_area() {
    let error = message(&worn(
        "load = \"compression\"\ncycles = [0, 10]\nforce_N = 1.0\ntravel_mm = 1.0",
    ));
    assert!(
        error.starts_with("s.toml, line 13: `travel_mm` with `load = \"compression\"`"),
        "{error}"
    );
    let error = message(&worn("load = \"shear\"\ncycles = [0, 10]\nforce_N = 1.0"));
    assert!(
        error.starts_with("s.toml, line 10: the load `shear` has no `travel_mm`"),
        "{error}"
    );
    let beyond = |load: &str, travel_mm: f64| {
        let lines = format!(
            "[protocol.wear]\nload = \"{load}\"\ncycles = [10]\nforce_N = 1.0\ntravel_mm = {travel_mm}"
        );
        planned(&lines, rig())
    };
    // Half of the sensing area is 8 mm along x. Abrasion moves over all of it.
    for (load, greatest) in [("shear", 8.0), ("abrasion", 16.0)] {
        assert!(beyond(load, greatest).starts_with("plan "), "{load}");
        let error = beyond(load, greatest + 0.5);
        assert!(
            error.starts_with("s.toml, line 13: `travel_mm` is ")
                && error.ends_with(&format!("expected at most {greatest}")),
            "{error}"
        );
    }
}

#[test]
fn a_load_that_moves_sideways_needs_a_transducer_that_measures_shear() {
    let normal = || RigInfo {
        force: Some(descriptor(
            "sim/force-transducer",
            Facts::Force(ForceFacts::default().with_axes(Axes::NORMAL)),
        )),
        ..rig()
    };
    let lines = "[protocol.wear]\nload = \"shear\"\ncycles = [10]\nforce_N = 1.0\ntravel_mm = 0.5";
    let error = planned(lines, normal());
    assert!(
        error.starts_with("s.toml, line 10: the load `shear` moves sideways in contact"),
        "{error}"
    );
    let lines = "[protocol.wear]\nload = \"compression\"\ncycles = [10]\nforce_N = 1.0";
    assert!(planned(lines, normal()).starts_with("plan "));
}

#[test]
fn a_recording_and_several_units_of_a_study_are_refused() {
    let text = "scene_version = 1\nname = \"gel\"\n[sensor]\ndataset = \"monday\"\n[protocol.wear]\nload = \"compression\"\ncycles = [10]\nforce_N = 1.0\n";
    let error = message(text);
    assert!(
        error.starts_with("s.toml, line 4: `dataset` with [protocol.wear]"),
        "{error}"
    );
    let units = worn(COMPRESSION).replace("[robot]", "units = [\"a\", \"b\"]\n[robot]");
    let error = message(&units);
    assert!(
        error.starts_with("s.toml, line 5: several `units` with [protocol.wear]"),
        "{error}"
    );
    let error = with("[protocol.wear]\nloads = 1");
    assert!(
        error.contains("`loads`: unknown key, did you mean `load`?"),
        "{error}"
    );
}
