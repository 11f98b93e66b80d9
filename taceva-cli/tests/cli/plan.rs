//! A plan describes a scene before anything is done, and refuses an impossible scene with its line.

use crate::support::Bench;

const SCENE: &str = r#"scene_version = 1
name = "one gel"
robot = { driver = "sim/robot" }
force = { driver = "sim/force-transducer" }
sensor = { driver = "sim/gelsight" }
"#;

#[test]
fn without_a_scene_the_built_in_one_is_planned_and_says_what_it_leaves_out() {
    let out = Bench::new().ok("plan");
    assert!(out.starts_with("scene quick, seed 11\n"), "{out}");
    assert_eq!(out.matches("\nplan  study").count(), 4, "{out}");
    let opaque = "r_light                          the gel is opaque";
    assert_eq!(out.matches(opaque).count(), 2, "{out}");
}

#[test]
fn a_plan_for_programs_names_every_press() {
    let bench = Bench::new();
    bench.write(
        "s.toml",
        &format!("{SCENE}metrics = {{ want = [\"sensitivity\"] }}\n"),
    );
    let plans = bench.json("plan s.toml --seed 3");
    assert_eq!(
        (&plans["schema"], &plans["seed"]),
        (&"taceva.plans/1".into(), &3.into())
    );
    let study = &plans["studies"][0];
    let presses = study["presses"].as_array().expect("a list");
    assert_eq!(study["cost"]["presses"], presses.len());
    assert_eq!(study["cost"]["frames"], 0, "nobody looks at a picture");
    let other = bench.json("plan s.toml --seed 4");
    assert_ne!(study["digest"], other["studies"][0]["digest"]);
}

#[test]
fn what_cannot_be_done_is_refused_with_the_line_and_what_is_known() {
    let bench = Bench::new();
    let cases = [
        (
            SCENE.replace("sim/gelsight", "sim/gelsigth"),
            "s.toml, line 5: `sim/gelsigth`: unknown driver of a sensor, did you mean `sim/gelsight`?",
        ),
        (
            format!("{SCENE}limits = {{ Pz_max_mm = 2.0 }}\n"),
            "s.toml, line 6: ",
        ),
        (
            format!("{SCENE}[protocol.calibration]\npionts = 3\n"),
            "s.toml, line 7: `pionts`: unknown key, did you mean `points`?",
        ),
        (
            SCENE.replace("sim/gelsight", "sim/gelsight:unti=3"),
            "s.toml, line 5: `sim/gelsight:unti=3`: ",
        ),
        (
            SCENE.replace("driver = \"sim/gelsight\"", "dataset = \"nowhere\""),
            "s.toml, line 5: ",
        ),
    ];
    for (scene, message) in cases {
        bench.write("s.toml", &scene);
        bench.refused("plan s.toml", 3, message);
    }
    bench.refused(
        "plan qick",
        2,
        "`qick`: no such scene, expected a file or one of quick, paper",
    );
    bench.refused(
        "plan nowhere.toml",
        3,
        "nowhere.toml: No such file or directory (os error 2): `taceva init scene --out nowhere.toml` writes one",
    );
    let no_rig = "`taceva init rig --out lab.toml` writes one";
    bench.refused("plan --rig lab.toml", 3, no_rig);
    bench.refused("rig check lab.toml", 3, no_rig);
    bench.refused("preview --rig lab.toml", 3, no_rig);
}

/// Rig file of devices that a plan does not open.
const RIG: &str = r#"rig_version = 1
[robot]
driver = "ufactory/xarm:host=127.0.0.1"
carries = "indenter"
origin_mm = [300.0, 0.0, 251.3]
axes = ["x", "-y", "-z"]
[force]
driver = "ati/netft:host=127.0.0.1"
axes = ["x", "-y", "-z"]
[sensor]
driver = "camera/mjpeg:url=http://127.0.0.1:9/"
[limits]
Pz_max_mm = 1.0
Fz_max_N = 2.0
"#;

/// Scene for the rig file [`RIG`].
const GEL: &str = "scene_version = 1\nname = \"gel\"\n[model]\nname = \"ridge\"\n[protocol.calibration]\npoints = 60\n";

#[test]
fn a_plan_for_a_rig_states_where_depths_count_from_unless_it_is_the_surface() {
    let bench = Bench::new();
    let area = "footprint = { shape = \"disc\", radius_mm = 8.0 }\n[limits]";
    bench.write("lab.toml", &RIG.replace("[limits]", area));
    bench.write("s.toml", GEL);
    let line = "rig: depths and the limit of depth count from the first force above 0.02 N, which can lie a step of 0.1 mm or more below the surface";
    let ran = bench.run("plan s.toml --rig lab.toml");
    assert_eq!(ran.code, 0, "{}{}", ran.out, ran.err);
    assert!(ran.err.contains(line), "{}", ran.err);
    let surface = format!("{GEL}[protocol.contact]\ndepth_from = \"surface\"\n");
    bench.write("s.toml", &surface);
    let ran = bench.run("plan s.toml --rig lab.toml");
    assert_eq!(ran.code, 0, "{}{}", ran.out, ran.err);
    assert!(!ran.err.contains("depths and the limit"), "{}", ran.err);
}

#[test]
fn a_rig_without_a_sensing_area_keeps_no_metric_and_names_the_line_that_states_it() {
    let bench = Bench::new();
    bench.write("lab.toml", RIG);
    bench.write("s.toml", GEL);
    let plan = "plan s.toml --rig lab.toml";
    let ran = bench.run(plan);
    assert_eq!(ran.code, 2, "{}{}", ran.out, ran.err);
    assert!(
        ran.err.contains("no metric is kept")
            && ran
                .err
                .contains("`footprint = { shape = \"disc\", radius_mm = … }`"),
        "{}",
        ran.err
    );
    let stated = RIG.replace(
        "[limits]",
        "footprint = { shape = \"disc\", radius_mm = 8.0 }\n[limits]",
    );
    bench.write("lab.toml", &stated);
    let ran = bench.run(plan);
    assert_eq!(ran.code, 0, "{}{}", ran.out, ran.err);
}
