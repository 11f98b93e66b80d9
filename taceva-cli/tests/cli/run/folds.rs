//! Runs that predict each contact point by a model fitted on other points.

use serde_json::Value;

use super::{SMALL, reports, with_small};
use crate::support::Bench;

/// The scene [`SMALL`] with `folds` folds of its 16 points.
fn folded(folds: usize) -> String {
    SMALL.replace(
        "name = \"ridge\"",
        &format!("name = \"ridge\", folds = {folds}"),
    )
}

/// Runs `scene`, and returns the report of its only study.
fn report(bench: &Bench, scene: &str) -> Value {
    bench.write("small.toml", scene);
    bench.ok("run small.toml --out r -q");
    serde_json::from_slice(&reports(&bench.path("r"))[0].1).expect("JSON")
}

#[test]
fn folds_of_a_run_predict_every_calibration_press_once() {
    let (one, bench) = (with_small(), with_small());
    one.ok("run small.toml --out r -q");
    let one: Value = serde_json::from_slice(&reports(&one.path("r"))[0].1).expect("JSON");
    let all = report(&bench, &folded(3));
    let n = |report: &Value| {
        report["metrics"]["mae"]["Fz"]["n"]
            .as_u64()
            .expect("a count")
    };
    let samples = &one["provenance"]["samples"];
    let count = |part: &str| samples[part].as_u64().unwrap_or(0);
    assert_eq!(n(&one), count("test"));
    assert_eq!(
        n(&all),
        count("train") + count("validation") + count("test")
    );
    let provenance = &all["provenance"];
    assert_eq!(provenance["split"], "cv:3 by-point");
    assert_eq!(provenance["samples"]["test"], n(&all));
    let notes = provenance["notes"].to_string();
    assert!(
        notes.contains("one of 3 models fitted without its group (16 groups)"),
        "{notes}"
    );
    assert_eq!(
        provenance["frames_decoded"],
        one["provenance"]["frames_decoded"]
    );
    // The recording is the same, whatever the model.
    assert_eq!(provenance["dataset"], one["provenance"]["dataset"]);
}

#[test]
fn a_run_by_folds_is_verified_by_its_samples() {
    let bench = with_small();
    bench.write("small.toml", &folded(3));
    bench.ok("run small.toml --out r -q");
    bench.ok("bundle r --draft --out b -q");
    bench.ok("bundle verify b --level predictions");
}

#[test]
fn folds_without_enough_points_or_with_a_kept_model_are_refused_before_a_press() {
    let bench = with_small();
    let refused = |scene: &str, words: &str| {
        bench.write("small.toml", scene);
        bench.refused("plan small.toml", 3, words);
    };
    refused(&folded(17), "expected 2 to 16");
    refused(&folded(1), "`folds` is 1");
    let keep = "report = { keep = [\"models\"] }\n";
    refused(&format!("{}{keep}", folded(3)), "no single model to keep");
    bench.write("small.toml", &folded(3));
    let planned = bench.ok("plan small.toml");
    assert!(planned.contains("a model for each of 3 folds"), "{planned}");
}

#[test]
fn a_typed_model_keeps_the_folds_of_the_scene() {
    let bench = with_small();
    bench.write("small.toml", &folded(3));
    let run = bench.json("run small.toml --model baseline --out r");
    let provenance = &run["studies"][0]["provenance"];
    assert_eq!(provenance["model"]["name"], "baseline");
    assert_eq!(provenance["split"], "cv:3 by-point");
}

#[test]
fn few_points_are_no_reason_for_a_warning_if_folds_test_all_of_them() {
    let bench = with_small();
    let warning = "the test part has";
    let one = bench.run("plan small.toml");
    assert!(one.err.contains(warning), "{}", one.err);
    bench.write("small.toml", &folded(3));
    let all = bench.run("plan small.toml");
    assert!(!all.err.contains(warning), "{}", all.err);
}

#[test]
fn folds_of_a_recording_without_contact_points_divide_by_what_is_detected() {
    let bench = Bench::new();
    bench.lab();
    let map = std::fs::read_to_string(bench.path("map.toml")).expect("a map");
    assert!(map.contains("point_id = \"point\"\n"), "{map}");
    bench.write("map.toml", &map.replace("point_id = \"point\"\n", ""));
    bench.ok("import lab --map map.toml --out data -q");
    let scene = "scene_version = 1\nname = \"again\"\nmodel = { name = \"ridge\", folds = 3, set = { size = \"8x8\" } }\n\
                 sensor = { dataset = \"data\" }\nmetrics = { want = [\"mae\"] }\n";
    bench.write("again.toml", scene);
    let run = bench.json("run again.toml --out r");
    let split = run["studies"][0]["provenance"]["split"].to_string();
    assert!(split.starts_with("\"cv:3"), "{split}");
}
