//! Models, settings and seeds that override those of the scene.

use std::fs;

use serde_json::Value;

use super::{SMALL, with_small};

#[test]
fn a_run_takes_another_model_settings_and_seeds_than_its_scene_names() {
    let bench = with_small();
    let words =
        "run small.toml --out run --model cnn --set size=16x16 --set epochs=2 --seeds 3,1,2";
    let run = bench.json(words);
    let study = &run["studies"][0];
    let model = &study["provenance"]["model"];
    assert_eq!(model["name"], "cnn");
    // The report is that of the first seed.
    let settings = &model["settings"];
    assert_eq!(
        (&settings["seed"], &settings["epochs"]),
        (&"3".into(), &"2".into())
    );
    let over = &study["over_seeds"];
    assert_eq!(over["seeds"], serde_json::json!([3, 1, 2]));
    let scores = over["scores"].as_array().expect("a list");
    let mae = |channel: &str| {
        let mut scores = scores.iter();
        let found = scores.find(|score| score["metric"] == "mae" && score["channel"] == channel);
        found.expect("predicted").clone()
    };
    let pz = mae("Pz");
    let values: Vec<f64> = pz["values"]
        .as_array()
        .expect("a list")
        .iter()
        .filter_map(Value::as_f64)
        .collect();
    assert_eq!(values.len(), 3);
    assert!(
        values
            .windows(2)
            .all(|pair| pair[0].to_bits() != pair[1].to_bits()),
        "{values:?}"
    );
    let of_report = &study["metrics"]["mae"]["Pz"]["value"];
    assert_eq!(
        of_report.as_f64(),
        Some(values[0]),
        "{}",
        study["metrics"]["mae"]
    );
    let mean = values.iter().sum::<f64>() / 3.0;
    assert!((pz["mean"].as_f64().expect("a number") - mean).abs() < 1e-12);
    let ends: Vec<f64> = pz["interval"]
        .as_array()
        .expect("two")
        .iter()
        .filter_map(Value::as_f64)
        .collect();
    assert!(
        0.0 <= ends[0] && ends[0] < mean && mean < ends[1],
        "{ends:?}"
    );
    // Measurements without a model do not depend on its seed.
    assert!(scores.iter().all(|score| score["metric"] != "sensitivity"));
    let text = fs::read_to_string(bench.path("run/reports/1-small.txt")).expect("there");
    assert!(
        text.contains("over the seeds 3, 1, 2 of the training"),
        "{text}"
    );
}

#[test]
fn seeds_of_a_model_that_draws_nothing_and_settings_of_none_are_refused_before_a_press() {
    let bench = with_small();
    bench.refused(
        "run small.toml --out a --seeds 1-3",
        2,
        "the model ridge uses no random numbers",
    );
    bench.refused("run small.toml --out a --set strenth=1", 2, "strenth");
    bench.refused("run small.toml --out a --model rigde", 2, "rigde");
    bench.refused("run small.toml --out a --seeds 1", 2, "2 to 100 different");
    let unnamed = SMALL.replace(
        "model = { name = \"ridge\", set = { size = \"8x8\" } }\n",
        "",
    );
    bench.write("none.toml", &unnamed);
    bench.refused(
        "run none.toml --out a --set size=8x8",
        2,
        "name one with --model",
    );
    assert!(!bench.path("a").exists());
}
