//! Tests of rig files, of every kind of invalid rig file, and of scenes that a rig file forbids.

mod gel;

use std::sync::Arc;

use taceva_core::{Millimetre, Point, Workspace};
use taceva_protocol::{Carried, Plan, RigFile, SceneProblem};

use super::*;

const RIG: &str = r#"rig_version = 1
[robot]
driver = "lab/arm:host=10.0.0.2"
carries = "indenter"
origin_mm = [300.0, 0.0, 251.3]
axes = ["x", "-y", "-z"]
[force]
driver = "lab/box"
axes = ["x", "-y", "-z"]
latency_ms = 4.0
[sensor]
driver = "lab/camera"
latency_ms = 38.0
[limits]
speed_max_mm_s = 20.0
"#;

/// Scene that states facts of a sensor, because the sensor's camera states none.
const SCENE: &str = r#"scene_version = 1
name = "my gel"
rig = "lab.toml"
limits = { Pz_max_mm = 1.0, Fz_max_N = 1.8 }
[sensor]
opaque = true
footprint = { shape = "rect", half_x_mm = 8.0, half_y_mm = 10.0 }
"#;

fn refused(from: &str, to: &str) -> String {
    assert!(RIG.contains(from), "{from}");
    let error = RigFile::parse("lab.toml", &RIG.replacen(from, to, 1)).expect_err("wrong");
    error.to_string()
}

fn put_on(scene: &str, rig: &str) -> Scene {
    let rig = Arc::new(RigFile::parse("lab.toml", rig).expect("a rig"));
    let mut scene = Scene::parse("s.toml", scene).expect("reads");
    scene.put_on(&rig).expect("it has a sensor");
    scene
}

/// Outcome of planning `scene` on the devices of `rig`: the error message if it fails.
fn planned_on(scene: &str, rig: &str) -> Result<(), String> {
    let devices = devices();
    plan(&put_on(scene, rig), |_| {
        SourceInfo::Rig(Box::new(devices.clone()))
    })
    .map(drop)
    .map_err(|error| error.to_string())
}

/// Test devices: an arm that reaches 500 mm along x of its base and 300 mm above the table, and a transducer that measures only Fz.
fn devices() -> RigInfo {
    let corner = |x: f64, y: f64, z: f64| {
        let [x, y, z] = [x, y, z].map(Millimetre);
        Point { x, y, z }
    };
    RigInfo {
        sensor: Some(descriptor("lab/camera", Facts::Sensor(Box::default()))),
        robot: Some(descriptor(
            "lab/arm",
            Facts::Robot(
                RobotFacts::default()
                    .with_workspace(Workspace {
                        least: corner(200.0, -100.0, 150.0),
                        greatest: corner(500.0, 100.0, 300.0),
                    })
                    .with_speed_max(Speed::try_new(100.0).expect("a speed")),
            ),
        )),
        force: Some(descriptor(
            "lab/box",
            Facts::Force(ForceFacts::default().with_axes(Axes::NORMAL)),
        )),
        lighting: None,
    }
}

#[test]
fn a_rig_file_says_which_drivers_and_how_they_stand() {
    let rig = RigFile::parse("lab.toml", RIG).expect("a rig");
    let robot = rig.robot.as_ref().expect("a robot");
    assert_eq!(robot.driver.value, "lab/arm:host=10.0.0.2");
    assert_eq!((robot.carries, robot.turned_deg), (Carried::Indenter, None));
    let latency_ms = rig.force.as_ref().and_then(|force| force.latency_ms);
    assert_eq!(latency_ms.map(|latency| latency.value), Some(4.0));
    assert_eq!(planned_on(SCENE, RIG), Ok(()));
    let scene = put_on(SCENE, RIG);
    let drivers: Vec<&str> = scene
        .drivers()
        .map(|(_, driver)| driver.value.as_str())
        .collect();
    assert_eq!(drivers, ["lab/camera", "lab/arm:host=10.0.0.2", "lab/box"]);
    let commented = RigFile::parse("lab.toml", &format!("{RIG}# moved\n")).expect("a rig");
    assert_ne!(rig.digest(), commented.digest());
}

#[test]
fn what_is_wrong_in_a_rig_file_is_refused_with_its_line_and_what_is_expected() {
    let axes = r#"axes = ["x", "-y", "-z"]"#;
    let cases = [
        (
            "rig_version = 1",
            "rig_version = 2",
            "lab.toml, line 1: rig version 2 is not supported, expected 1",
        ),
        (
            axes,
            r#"axes = ["x", "y", "-z"]"#,
            "lab.toml, line 6: `axes` are left-handed (x, y, -z)",
        ),
        (
            axes,
            r#"axes = ["x", "x", "-z"]"#,
            "lab.toml, line 6: `axes` name one axis twice",
        ),
        (
            axes,
            r#"axes = ["x", "up", "-z"]"#,
            "lab.toml, line 6: `axes`: `up` names no axis",
        ),
        (axes, r#"axes = ["x", "-y"]"#, "lab.toml, line 6: "),
        (
            axes,
            "axs = 3",
            "lab.toml, line 6: `axs`: unknown key, did you mean `axes`?",
        ),
        (
            "\"indenter\"",
            "\"nothing\"",
            "lab.toml, line 4: unknown variant `nothing`, expected `indenter` or `sensor`",
        ),
        (
            "carries = \"indenter\"\n",
            "",
            "lab.toml, line 2: the key `carries` is missing",
        ),
        (
            "[300.0,",
            "[nan,",
            "lab.toml, line 5: `origin_mm` is NaN, expected three numbers from -10000 to 10000 mm",
        ),
        (
            "38.0",
            "-1.0",
            "lab.toml, line 13: `latency_ms` is -1, expected 0 to 1000 ms",
        ),
        (
            "latency_ms = 4.0",
            "latency_ms = 4.0\nzero_step_max_N = 0.0",
            "lab.toml, line 11: `zero_step_max_N` is 0, expected a number above 0 and up to 1000",
        ),
        (
            "20.0",
            "0.0",
            "lab.toml, line 15: `speed_max_mm_s` is 0, expected a number above 0 and up to 1000",
        ),
        (
            "[limits]",
            "[operator]\nenable = \"hid/pedal\"\npatience_s = 0.0\n[limits]",
            "lab.toml, line 16: `patience_s` is 0, expected a number above 0 and up to 86400",
        ),
        (
            "[limits]",
            "[operator]\nenabel = \"hid/pedal\"\n[limits]",
            "lab.toml, line 15: `enabel`: unknown key, did you mean `enable`?",
        ),
        ("[robot]", "[robot", "lab.toml, line 2: "),
    ];
    for (from, to, expected) in cases {
        let said = refused(from, to);
        assert!(said.starts_with(expected), "{said}\nexpected {expected}");
    }
}

#[test]
fn limits_of_a_rig_tighten_those_of_its_devices_and_a_scene_may_not_loosen_them() {
    assert_eq!(
        planned_on(SCENE, &RIG.replace("20.0", "120.0")).expect_err("faster than the arm"),
        "lab.toml, line 15: `speed_max_mm_s` is 120, but the robot `lab/arm` allows at most 100: limits may only be tightened"
    );
    let faster = SCENE.replace("Pz_max_mm = 1.0", "Pz_max_mm = 1.0, speed_max_mm_s = 30.0");
    assert_eq!(
        planned_on(&faster, RIG).expect_err("faster than the rig"),
        "s.toml, line 4: `speed_max_mm_s` is 30, but [limits] of the rig file `lab.toml` allows at most 20: limits may only be tightened"
    );
    let devices = devices();
    let zero = "latency_ms = 4.0\nzero_step_max_N = 0.05";
    let rig = RIG.replace("latency_ms = 4.0", zero);
    let plans = plan(&put_on(SCENE, &rig), |_| {
        SourceInfo::Rig(Box::new(devices.clone()))
    });
    let limits = plans.expect("plans")[0].limits.clone().expect("it moves");
    assert!(limits.speed_max_mm_s <= 20.0, "{limits:?}");
    assert_eq!(limits.signals.zero_step_max_n, Some(0.05));
}

#[test]
fn a_place_that_the_arm_does_not_reach_is_refused_in_its_base_frame_with_the_line_of_the_rig() {
    let said = planned_on(SCENE, &RIG.replace("251.3", "299.9")).expect_err("too high");
    assert!(
        said.starts_with("lab.toml, line 3: the robot `lab/arm` does not reach (292 mm, 10 mm, 30"),
        "{said}"
    );
    assert!(
        said.contains("Correct `origin_mm`, `axes` or the workspace"),
        "{said}"
    );
}

#[test]
fn a_transducer_on_its_side_measures_no_normal_force() {
    let aside = RIG.replace(
        "driver = \"lab/box\"\naxes = [\"x\", \"-y\", \"-z\"]",
        "driver = \"lab/box\"\naxes = [\"z\", \"x\", \"y\"]",
    );
    let devices = devices();
    let plans = |rig: &str| {
        let info = SourceInfo::Rig(Box::new(devices.clone()));
        plan(&put_on(SCENE, rig), |_| info.clone()).expect("plans")[0]
            .channels
            .clone()
    };
    assert!(plans(RIG).contains(&"Fz".to_owned()), "{:?}", plans(RIG));
    assert!(
        !plans(&aside).contains(&"Fz".to_owned()),
        "{:?}",
        plans(&aside)
    );
}

#[test]
fn a_scene_with_a_rig_names_no_devices_and_one_without_names_them() {
    let both = SCENE.replace("[sensor]\n", "[sensor]\ndriver = \"lab/camera\"\n");
    assert_eq!(
        message(&both),
        "s.toml, line 6: the scene has both `rig` and `driver`: remove `driver`, since the rig file names the devices"
    );
    let none = SCENE.replace("rig = \"lab.toml\"\n", "");
    assert!(message(&none).contains("[sensor] has neither `driver` nor `dataset`"));
    assert!(Scene::parse_for_rig("s.toml", &none).is_ok());
    let mut blind = Scene::parse("s.toml", SCENE).expect("reads");
    let (without, _) = RIG.split_once("[sensor]").expect("a sensor");
    let without = Arc::new(RigFile::parse("lab.toml", without).expect("a rig"));
    let error = blind.put_on(&without).expect_err("no sensor");
    assert_eq!(error.to_string(), "lab.toml: the key `sensor` is missing");
}

#[test]
fn a_driver_that_is_not_linked_in_is_refused_with_the_line_of_the_rig() {
    let scene = put_on(SCENE, RIG);
    let known = [(taceva_core::DriverKind::Sensor, "lab/camer")];
    let error = scene.check_drivers(&known).expect_err("unknown");
    assert!(
        error.to_string().starts_with(
            "lab.toml, line 12: `lab/camera`: unknown driver of a sensor, did you mean `lab/camer`?"
        ),
        "{error}"
    );
}

#[test]
fn a_rig_says_whether_it_is_emulated_and_is_real_where_it_says_nothing() {
    let parse = |text: &str| taceva_protocol::RigFile::parse("rig.toml", text).expect("a rig");
    assert!(!parse(RIG).simulated);
    let emulated = RIG.replacen(
        "rig_version = 1\n",
        "rig_version = 1\nsimulated = true\n",
        1,
    );
    assert!(parse(&emulated).simulated);
}

#[test]
fn a_robot_that_moves_in_its_base_frame_is_refused_without_a_rig_file_that_maps_it() {
    let mut devices = devices();
    let in_base = RobotFacts::default().with_base_frame(true);
    devices.robot = Some(descriptor("lab/arm", Facts::Robot(in_base)));
    let text = SCENE.replacen(
        "rig = \"lab.toml\"\n",
        "robot = { driver = \"lab/arm\" }\nforce = { driver = \"lab/box\" }\n",
        1,
    );
    let text = text.replacen("[sensor]\n", "[sensor]\ndriver = \"lab/camera\"\n", 1);
    let scene = Scene::parse("s.toml", &text).expect("reads");
    let planned =
        |scene: &Scene| plan(scene, |_| SourceInfo::Rig(Box::new(devices.clone()))).map(drop);
    let error = planned(&scene).expect_err("nothing says how its base lies to the gel");
    assert_eq!(error.line, Some(3), "{error}");
    let robot = "lab/arm".to_owned();
    assert_eq!(*error.problem, SceneProblem::Unmapped { robot });
    let said = error.to_string();
    assert!(
        said.contains("`origin_mm` and `axes`") && said.contains("--rig"),
        "{said}"
    );
    // A rig file maps the base frame.
    planned(&put_on(SCENE, RIG)).expect("it is mapped");
}

/// Test devices that count as real. The transducer states the range `range_n`, in N.
fn real_devices(range_n: f64) -> RigInfo {
    let real = |key: &'static str, facts: Facts| {
        let spec = DescriptorSpec::new(DriverKey::fixed(key), key, DriverSource::Real, facts);
        Some(spec.check().expect("no contradiction"))
    };
    let force = ForceFacts::default()
        .with_axes(Axes::FORCE)
        .with_force_max(Newton(range_n));
    RigInfo {
        sensor: real("lab/camera", Facts::Sensor(Box::default())),
        robot: real("lab/arm", Facts::Robot(RobotFacts::default())),
        force: real("lab/box", Facts::Force(force)),
        lighting: None,
    }
}

fn plan_on_real(range_n: f64, rig: &str) -> Plan {
    let devices = real_devices(range_n);
    let plans = plan(&put_on(SCENE, rig), |_| {
        SourceInfo::Rig(Box::new(devices.clone()))
    });
    plans.expect("plans").remove(0)
}

#[test]
fn the_range_of_a_transducer_never_loosens_the_limit_of_the_shear_force() {
    let shear_n = |range_n: f64, rig: &str| {
        let limits = plan_on_real(range_n, rig).limits.expect("it moves");
        limits.shear_max.0
    };
    // The limit of the normal force is 1.8 N.
    for (range_n, expected_n) in [(50.0, 1.8), (1.8, 1.8)] {
        let found_n = shear_n(range_n, RIG);
        assert!((found_n - expected_n).abs() < 1e-12, "{range_n}: {found_n}");
    }
    let written = RIG.replace("[limits]\n", "[limits]\nFxy_max_N = 3.0\n");
    assert!((shear_n(50.0, &written) - 3.0).abs() < 1e-12);
}

#[test]
fn sheared_presses_of_a_real_rig_stay_inside_the_footprint_and_keep_their_length() {
    let footprint = Footprint::rectangle(8.0, 10.0, None).expect("lengths");
    let leaves = |plan: &Plan| {
        let presses = plan.presses.iter().map(|planned| &planned.press);
        let left = presses.filter(|press| {
            let [x, y] = press.place;
            let mut shears = press.waypoints().iter().map(|waypoint| waypoint.shear);
            shears.any(|[along_x, along_y]| {
                let [x, y] = [(x, along_x), (y, along_y)]
                    .map(|(place, along)| taceva_core::Nanometre(place.0 + along.0));
                !footprint.contains(x, y)
            })
        });
        left.count()
    };
    let real = plan_on_real(50.0, RIG);
    let greatest_mm = |plan: &Plan| {
        let presses = plan.presses.iter();
        let shears = presses.map(|planned| planned.press.greatest_shear_mm());
        shears.fold(0.0, f64::max)
    };
    assert_eq!(leaves(&real), 0);
    // An emulated gel needs no protection: its presses are those of the simulated bench, some of which leave.
    let emulated = RIG.replacen(
        "rig_version = 1\n",
        "rig_version = 1\nsimulated = true\n",
        1,
    );
    let emulated = plan_on_real(50.0, &emulated);
    assert!(leaves(&emulated) > 0);
    assert!((greatest_mm(&real) - greatest_mm(&emulated)).abs() < 1e-12);
}
