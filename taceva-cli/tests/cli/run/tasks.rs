//! Scores of tasks in a run: contact shapes and changes of pose beside slip, requested by their metrics.

use std::fs;

use serde_json::Value;

use super::resume::survives;
use crate::support::Bench;

const SCENE: &str = r#"scene_version = 1
name = "tasks"
seed = 7
robot = { driver = "sim/robot" }
force = { driver = "sim/force-transducer" }
model = { name = "ridge", set = { size = "8x8" } }
sensor = { driver = "sim/gelsight:reduction=16" }
metrics = { want = ["f1", "pose_rotation", "depth_rmse"] }
protocol = { calibration = { points = 12, indentations = 3 }, slip = { strokes = 6 }, shape = { presses = 6, depths = 2 }, pose = { pairs = 6 } }
"#;

fn study(bench: &Bench, folder: &str) -> Value {
    let bytes = fs::read(bench.path(folder).join("results.json")).expect("results");
    let results: Value = serde_json::from_slice(&bytes).expect("JSON");
    results["studies"][0].clone()
}

/// Estimate of the score `metric` of the task called `task`, without a variant.
fn estimate(study: &Value, task: &str, metric: &str) -> Value {
    let tasks = study["tasks"].as_array().expect("tasks");
    let task = tasks.iter().find(|found| found["name"] == task);
    let scores = task.expect("a task")["scores"].as_array().expect("a list");
    let is_own = |score: &&Value| score["metric"] == metric && score["variant"].is_null();
    scores.iter().find(is_own).expect("a score")["estimate"].clone()
}

#[test]
fn scores_of_tasks_are_requested_by_name_and_take_their_presses_from_the_scene() {
    let bench = Bench::new();
    bench.write("tasks.toml", SCENE);
    let plan = bench.ok("plan tasks.toml");
    assert!(plan.contains("calibration, slip, shape, pose"), "{plan}");
    bench.ok("run tasks.toml --out out -q");
    let study = study(&bench, "out");
    assert_eq!(estimate(&study, "slip", "f1")["clusters"], 6);
    let depth = estimate(&study, "shape", "depth_rmse");
    let value = depth["value"].as_f64().expect("a number");
    assert!(value > 0.0 && value < 1.0, "{depth}");
    assert_eq!(depth["clusters"], 6, "{depth}");
    assert!(depth["of_constant"].is_number(), "{depth}");
    for metric in ["pose_translation", "pose_rotation"] {
        let moved = estimate(&study, "pose", metric);
        assert!(moved["value"].as_f64().expect("a number") > 0.0, "{moved}");
        // Zero motion is the constant, and every pair moves.
        assert!(
            moved["of_constant"].as_f64().expect("a number") > 0.0,
            "{moved}"
        );
        assert_eq!(moved["n"], 6, "{moved}");
        assert_eq!(moved["clusters"], 6, "{moved}");
    }
    // No metric of channels was requested, except the skill of the model.
    let metrics = study["metrics"].as_object().expect("scores");
    assert!(
        metrics.keys().all(|metric| metric == "skill"),
        "{metrics:?}"
    );
}

#[test]
fn a_run_with_presses_of_tasks_alone_has_scores_of_tasks_alone() {
    let bench = Bench::new();
    let alone = SCENE
        .replace(", \"depth_rmse\"", "")
        .replace(", shape = { presses = 6, depths = 2 }", "");
    bench.write("tasks.toml", &alone);
    let plan = bench.ok("plan tasks.toml");
    assert!(plan.contains("run   phase   slip, pose "), "{plan}");
    bench.ok("run tasks.toml --out out -q");
    let study = study(&bench, "out");
    assert_eq!(study["metrics"], serde_json::json!({}));
    assert!(estimate(&study, "slip", "f1")["value"].is_number());
    assert!(estimate(&study, "pose", "pose_rotation")["value"].is_number());
}

#[test]
fn a_score_without_its_presses_is_refused_with_the_line_to_write() {
    let bench = Bench::new();
    bench.write("tasks.toml", &SCENE.replace(", pose = { pairs = 6 }", ""));
    bench.refused(
        "run tasks.toml --out out",
        3,
        "write `pose = { pairs = 40 }` under [protocol]",
    );
    let model = "model = { name = \"ridge\", set = { size = \"8x8\" } }\n";
    let blind = SCENE.replace(model, "");
    assert_ne!(blind, SCENE);
    bench.write("tasks.toml", &blind);
    bench.refused("plan tasks.toml", 3, "needs a model: none chosen");
}

#[test]
fn a_run_with_tasks_goes_on_to_the_same_bytes() {
    let bench = Bench::new();
    bench.write("small.toml", &SCENE.replace("\"tasks\"", "\"small\""));
    survives(&bench, &[3_000]);
}
