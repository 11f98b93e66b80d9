//! Recordings of runs that are scored again.

use std::fs;

use serde_json::Value;

use super::{SMALL, reports, with_small};
use crate::support::Bench;

#[test]
fn what_was_recorded_is_scored_again_without_a_press() {
    let bench = with_small();
    bench.ok("run small.toml --out first -q");
    let again = "scene_version = 1\nname = \"again\"\nmodel = { name = \"ridge\", set = { size = \"8x8\" } }\n\
                 sensor = { dataset = \"../first/recordings/1-small\" }\n";
    bench.write("scenes/again.toml", again);
    let run = bench.json("run scenes/again.toml --out again");
    let report = &run["studies"][0];
    assert_eq!(report["subject"]["source"], "simulated");
    assert!(
        report["metrics"]["mae"]["Fz"]["value"].is_number(),
        "{report}"
    );
    assert!(
        report["metrics"]["sr"]["line"]["value"].is_number(),
        "{report}"
    );
    assert!(
        fs::read_dir(bench.path("again/recordings"))
            .expect("a folder")
            .next()
            .is_none()
    );
}

#[test]
fn a_recording_of_a_run_is_evaluated_with_the_channels_and_the_split_of_its_plan() {
    let bench = with_small();
    bench.ok("run small.toml --out r -q");
    let report = bench.json("evaluate r/recordings/1-small --model ridge --set size=8x8");
    let provenance = &report["provenance"];
    let ran: Value = serde_json::from_slice(&reports(&bench.path("r"))[0].1).expect("JSON");
    assert_eq!(provenance["split"], ran["provenance"]["split"]);
    assert_eq!(provenance["samples"], ran["provenance"]["samples"]);
    assert_eq!(provenance["seed"], 7);
    let notes = provenance["notes"].to_string();
    assert!(notes.contains("as its plan does"), "{notes}");
    bench.ok("fit r/recordings/1-small --model ridge --set size=8x8 --out m.taceva -q");
    let again = bench.json("evaluate r/recordings/1-small --with m.taceva");
    assert_eq!(again["metrics"], report["metrics"]);
    // A model that reads no picture, on the same channels and presses.
    let constant = bench.json("evaluate r/recordings/1-small --model baseline --metrics accuracy");
    assert_eq!(constant["provenance"]["samples"], provenance["samples"]);
    let channels = |report: &Value| {
        let scores = report["metrics"]["mae"].as_object().expect("scores");
        scores.keys().cloned().collect::<Vec<_>>()
    };
    assert_eq!(channels(&constant), channels(&report));
    bench.ok("fit r/recordings/1-small --model baseline --out b.taceva -q");
    bench.ok("evaluate r/recordings/1-small --with b.taceva -q");
    bench.ok("check r/recordings/1-small -q");
    fs::rename(bench.path("r/recordings/1-small"), bench.path("moved")).expect("moved");
    bench.refused(
        "evaluate moved --with m.taceva",
        2,
        "in the folder of that run",
    );
}

#[test]
fn the_recording_of_a_run_passes_every_check() {
    let bench = Bench::new();
    // Enough contact points for intervals, of one unit.
    let scene = SMALL.replace("points = 16", "points = 60");
    bench.write("small.toml", &scene.replace(r#"["0", "1"]"#, r#"["0"]"#));
    bench.ok("run small.toml --out r -q");
    let report = bench.json("check r/recordings/1-small");
    let findings = report["findings"].as_array().expect("a list");
    let notes = |finding: &Value| finding["severity"] == "note";
    assert!(findings.iter().all(notes), "{findings:#?}");
}
