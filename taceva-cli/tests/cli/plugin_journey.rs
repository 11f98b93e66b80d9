//! A plugin from an empty folder to a report: created, built without a network, checked, listed, and used.

#![cfg(target_os = "linux")]

use std::fs;

use crate::support::Bench;
use serde_json::Value;

/// Scene with a sensor of a plugin over a simulated gel. Its pictures do not show the presses, but the forces are those of the gel.
const EYE: &str = r#"scene_version = 1
name = "eye"
seed = 7
robot = { driver = "sim/robot:gel=gelsight" }
force = { driver = "sim/force-transducer" }
model = { name = "ridge", set = { size = "8x6" } }
sensor = { driver = "org.example.my-eye/my-eye:brightness=180" }
protocol = { calibration = { points = 6, indentations = 2 }, hysteresis = { points = 2, depth_step_mm = 0.5 }, idle = { frames = 6 } }
metrics = { want = ["mae", "sensitivity", "hysteresis", "intrinsic"] }
"#;

#[test]
fn a_sensor_is_begun_built_checked_listed_and_measured() {
    let bench = Bench::new();
    bench.make_plugin("sensor", "my-eye");

    let checked = bench.json("plugin check org.example.my-eye --plugin-dir my-eye");
    assert_eq!(checked["failed"], 0, "{checked}");
    let devices = bench.ok("devices --plugin-dir my-eye");
    assert!(devices.contains("org.example.my-eye/my-eye"), "{devices}");
    let looked = bench.run("doctor --plugin-dir my-eye");
    assert!(
        looked.out.contains("org.example.my-eye/my-eye"),
        "{}",
        looked.out
    );
    assert!(
        !looked.out.contains("problem  org.example"),
        "{}",
        looked.out
    );

    bench.write("eye.toml", EYE);
    let run = bench.json("run eye.toml --plugin-dir my-eye --out first");
    let report = &run["studies"][0];
    assert_eq!(report["subject"]["source"], "simulated");
    let gel = report["subject"]["gel"].as_str().expect("a name");
    assert!(
        gel.starts_with("bench ") && gel.ends_with("seed 7"),
        "{gel}"
    );
    let metrics = &report["metrics"];
    // The camera sends 100 pictures a second by its own clock, on the bench too.
    let rate_hz = metrics["intrinsic"]["frame_rate"]["value"].as_f64();
    assert!((rate_hz.expect("a rate") - 100.0).abs() < 0.1, "{metrics}");
    for metric in ["mae", "sensitivity", "hysteresis"] {
        let value = metrics[metric]["Fz"]["value"].as_f64();
        assert!(
            value.is_some_and(|value| value > 0.0),
            "{metric}: {metrics}"
        );
    }
    assert!(bench.path("first/report.html").exists());

    // The same bytes again, as for any simulated rig. Another brightness gives another picture.
    let again = bench.json("run eye.toml --plugin-dir my-eye --out again");
    let dataset = |run: &Value| run["studies"][0]["provenance"]["dataset"].clone();
    assert_eq!(dataset(&run), dataset(&again));
    bench.write("eye.toml", &EYE.replace("=180", "=181"));
    let other = bench.json("run eye.toml --plugin-dir my-eye --out other");
    assert_ne!(dataset(&run), dataset(&other));
}

#[test]
fn what_one_build_of_a_plugin_recorded_is_not_taken_for_what_another_records() {
    let bench = Bench::with_cache();
    bench.make_plugin("sensor", "my-eye");
    bench.write("eye.toml", EYE);
    let acquired = |run: &str| {
        bench.ok(&format!("run eye.toml --plugin-dir my-eye --out {run} -q"));
        let stages = fs::read(bench.path(run).join("stages.json")).expect("written");
        let stages: Value = serde_json::from_slice(&stages).expect("JSON");
        let stages = stages["stages"].as_array().expect("a list").clone();
        let acquire = stages.into_iter().find(|stage| stage["stage"] == "acquire");
        acquire.expect("it was recorded")["reused"] == true
    };
    assert!(!acquired("first"));
    assert!(acquired("second"));
    let source = bench.path("my-eye/src/sensor.rs");
    let text = fs::read_to_string(&source).expect("there");
    let brighter = text.replace("row.fill(40)", "row.fill(41)");
    assert_ne!(text, brighter);
    fs::write(&source, brighter).expect("written");
    bench.build_plugin("my-eye");
    assert!(!acquired("third"));
}
