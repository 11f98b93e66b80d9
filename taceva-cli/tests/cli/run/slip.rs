//! Strokes until the indenter slides: slip is labelled by friction, predicted and scored.

use std::fs;

use serde_json::Value;

use crate::support::Bench;

const SCENE: &str = r#"scene_version = 1
name = "slip"
seed = 7
robot = { driver = "sim/robot" }
force = { driver = "sim/force-transducer" }
model = { name = "ridge", set = { size = "8x8" } }
sensor = { driver = "sim/gelsight:reduction=16" }
metrics = { want = ["mae"] }
protocol = { calibration = { points = 8, indentations = 2 }, slip = { strokes = 6 } }
"#;

#[test]
fn slip_of_strokes_is_labelled_by_friction_and_scored_by_stroke() {
    let bench = Bench::new();
    bench.write("slip.toml", SCENE);
    let plan = bench.ok("plan slip.toml");
    assert!(plan.contains("slip"), "{plan}");
    bench.ok("run slip.toml --out out -q");
    let bytes = fs::read(bench.path("out/results.json")).expect("results");
    let results: Value = serde_json::from_slice(&bytes).expect("JSON");
    let task = &results["studies"][0]["tasks"][0];
    assert_eq!(task["name"], "slip", "{results:#}");
    assert_eq!(task["positive"], "slip");
    let scores = task["scores"].as_array().expect("a list");
    let f1 = scores.iter().find(|score| score["metric"] == "f1");
    let estimate = &f1.expect("an event has an F1")["estimate"];
    assert_eq!(estimate["clusters"], 6, "{task:#}");
    // Eleven frames a stroke, unless a limit of force ends it.
    assert!(estimate["n"].as_u64().expect("a count") > 40, "{task:#}");
    // The ball slides in the second part of a stroke, and sticks in the first.
    let cells = task["confusion"].as_array().expect("a list");
    for class in ["slip", "no_slip"] {
        assert!(cells.iter().any(|cell| cell["truth"] == class), "{task:#}");
    }
}

#[test]
fn a_scene_without_strokes_has_no_scores_of_tasks() {
    let bench = Bench::new();
    bench.write("plain.toml", &SCENE.replace(", slip = { strokes = 6 }", ""));
    bench.ok("run plain.toml --out out -q");
    let bytes = fs::read(bench.path("out/results.json")).expect("results");
    let results: Value = serde_json::from_slice(&bytes).expect("JSON");
    assert!(results["studies"][0].get("tasks").is_none(), "{results:#}");
}
