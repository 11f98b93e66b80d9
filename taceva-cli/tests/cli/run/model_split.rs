//! Runs whose scene states the split of its calibration points.

use super::{SMALL, with_small};
use crate::support::Bench;

/// The scene [`SMALL`] with the split `split` of its 16 points.
fn split_by(split: &str) -> String {
    SMALL.replace(
        "name = \"ridge\"",
        &format!("name = \"ridge\", split = \"{split}\""),
    )
}

#[test]
fn the_split_of_a_scene_decides_how_many_points_are_scored() {
    let bench = with_small();
    bench.write("small.toml", &split_by("by-point 40/10/50"));
    let plan = bench.run("plan small.toml");
    assert_eq!(plan.code, 0, "{}", plan.err);
    assert!(!plan.err.contains("the test part has"), "{}", plan.err);
    let run = bench.json("run small.toml --out r");
    let study = &run["studies"][0];
    assert_eq!(study["provenance"]["split"], "by-point 40/10/50");
    let samples = &study["provenance"]["samples"];
    // Two indentations of one sample at each of 6, 2 and 8 points.
    let counts = ["train", "validation", "test"].map(|part| samples[part].as_u64());
    let [Some(train), Some(validation), Some(test)] = counts else {
        panic!("{samples}");
    };
    assert_eq!(
        (train % 6, validation % 2, test % 8),
        (0, 0, 0),
        "{samples}"
    );
    assert_eq!(
        (train / 6, validation / 2),
        (test / 8, test / 8),
        "{samples}"
    );
    assert_eq!(study["metrics"]["mae"]["Fz"]["n"], test);
}

#[test]
fn another_model_keeps_the_split_of_the_scene() {
    let bench = with_small();
    bench.write("small.toml", &split_by("by-point 40/10/50"));
    let run = bench.json("run small.toml --model baseline --out r");
    let provenance = &run["studies"][0]["provenance"];
    assert_eq!(provenance["split"], "by-point 40/10/50");
}

#[test]
fn a_split_that_cannot_divide_the_points_is_refused_before_a_press() {
    let bench = with_small();
    let refused = |scene: &str, words: &str| {
        bench.write("small.toml", scene);
        bench.refused("plan small.toml", 3, words);
    };
    refused(&split_by("by-points"), "no split is called `by-points`");
    refused(
        &split_by("random"),
        "presses at one contact point must be in one part",
    );
    refused(&split_by("cv:5"), "use `folds` instead");
    refused(&split_by("by-point 50/60/70"), "adds up to");
    refused(&split_by("by-point 80/20/0"), "leaves nothing to score");
    refused(&split_by("all"), "leaves nothing to score");
    let both = "name = \"ridge\", folds = 3";
    let both = split_by("by-point").replace("name = \"ridge\"", both);
    refused(&both, "`folds` tests every contact point");
}

#[test]
fn a_recording_of_a_scene_may_be_split_at_random() {
    let bench = Bench::new();
    bench.lab();
    bench.ok("import lab --map map.toml --out data -q");
    let scene = "scene_version = 1\nname = \"again\"\nmodel = { name = \"ridge\", split = \"random 40/10/50\", set = { size = \"8x8\" } }\n\
                 sensor = { dataset = \"data\" }\nmetrics = { want = [\"mae\"] }\n";
    bench.write("again.toml", scene);
    let run = bench.json("run again.toml --out r");
    let split = run["studies"][0]["provenance"]["split"].to_string();
    assert!(split.starts_with("\"random 40/10/50"), "{split}");
}
