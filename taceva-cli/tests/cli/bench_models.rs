//! Models compared on a recording made by the simulated bench.

use crate::support::Bench;

#[test]
fn models_are_raced_on_one_split_of_the_simulated_bench() {
    let bench = Bench::new();
    let race = bench.json(
        "bench models --quick --model baseline --model ridge:size=16x16 --model knn:size=16 \
         --model cnn:batch=4096 --svg models.svg",
    );
    assert_eq!(
        (&race["schema"], &race["subject"]),
        (&"taceva.bench/1".into(), &"models".into())
    );
    assert_eq!(race["recording"]["source"], "simulated");
    let rows = race["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), 4);
    let error = |row: usize, channel: &str| {
        let errors = rows[row]["errors"].as_array().expect("errors");
        let own = errors.iter().find(|error| error["channel"] == channel);
        own.expect("there")["mae"].as_f64().expect("a number")
    };
    // Six contact points remain for scoring: enough for the position, not for the depth.
    for channel in ["Px", "Py"] {
        assert!(error(1, channel) < error(0, channel), "{channel}");
        assert!(error(2, channel) < error(0, channel), "{channel}");
    }
    for row in &rows[..3] {
        assert!(row["fit_s"].as_f64().is_some_and(|time| time > 0.0));
        assert!(row["latency_s"].as_f64().is_some_and(|time| time > 0.0));
    }
    // A batch larger than the training part: that model reports the reason, the others are present.
    let failed = rows[3]["failed"].as_str().expect("said");
    assert!(failed.ends_with("fewer than a batch of 4096"), "{failed}");
    assert_eq!(rows[1]["settings"], "size=16x16");
    let drawing = std::fs::read_to_string(bench.path("models.svg")).expect("written");
    assert!(drawing.starts_with("<svg ") && drawing.contains("ridge"));
}

#[test]
fn models_of_libraries_race_beside_ours_and_auto_may_take_one() {
    let bench = Bench::new();
    let race = bench.json(
        "bench models --quick --model ridge:size=8x8 --model linfa/pls:size=8x8 --model smartcore/knn:size=8x8 \
         --model auto:size=8x8,budget_s=0.5",
    );
    let rows = race["rows"].as_array().expect("rows");
    let names: Vec<&str> = rows
        .iter()
        .filter_map(|row| row["model"].as_str())
        .collect();
    assert_eq!(names, ["ridge", "linfa/pls", "smartcore/knn", "auto"]);
    assert!(rows.iter().all(|row| row["failed"].is_null()), "{rows:?}");
    bench.refused(
        "bench models --quick --model linfa/plss",
        2,
        "did you mean `linfa/pls`",
    );
}

#[test]
fn an_unknown_model_or_setting_is_refused_before_anything_is_fitted() {
    let bench = Bench::new();
    bench.refused(
        "bench models --quick --model rigde",
        2,
        "did you mean `ridge`",
    );
    bench.refused(
        "bench models --quick --model ridge --model knn:neighbors=3",
        2,
        "did you mean `neighbours`",
    );
}
