//! Test of the README's path from a lab's folder to scores.

use crate::support::{Bench, SAMPLES, leftovers};
use serde_json::Value;

#[test]
fn a_folder_of_pictures_becomes_scores_in_two_commands() {
    let bench = Bench::imported();
    let text = bench.ok("evaluate data --model ridge --set size=8 --part all");
    for word in [
        "mae",
        "r2",
        "smape",
        "Px",
        "Fz",
        "95 % interval",
        "jackknife by point_id",
        "recorded",
    ] {
        assert!(text.contains(word), "no `{word}` in\n{text}");
    }
    let report =
        bench.json("evaluate data --model ridge --split by-point --set size=8 --metrics r2");
    let r2 = report["metrics"]["r2"]["Fz"]["value"]
        .as_f64()
        .expect("a number");
    assert!(r2 > 0.9, "the brightness of a blob is easy to see: {r2}");
    assert_eq!(report["schema"], "taceva.evaluation/1.0");
    assert_eq!(report["provenance"]["frames_decoded"], SAMPLES);
}

#[test]
fn predictions_that_are_scored_as_tables_give_what_evaluate_gives() {
    let bench = Bench::imported();
    bench.ok("fit data --model pls --set size=8 --split random --seed 3 --out model --split-out split.json");
    bench.ok("predict data --with model --out pred.csv --truth-out truth.csv");
    let mut evaluated = bench.json("evaluate data --with model");
    let mut scored = bench.json("score --truth truth.csv --pred pred.csv");
    // Tables contain neither the training labels nor the bounds of the model.
    for report in [&mut evaluated, &mut scored] {
        without_skill(report);
    }
    // A recording also has pictures and times; tables of positions and forces do not.
    scored["metrics"]["intrinsic"] = evaluated["metrics"]["intrinsic"].clone();
    assert_eq!(evaluated["metrics"], scored["metrics"]);
    assert!(evaluated["metrics"]["mae"]["Px"]["value"].is_number());
    let mut refitted = bench.json("evaluate data --model pls --set size=8 --split random --seed 3");
    without_skill(&mut refitted);
    assert_eq!(evaluated["metrics"], refitted["metrics"]);
    let split: Value =
        serde_json::from_str(&std::fs::read_to_string(bench.path("split.json")).expect("written"))
            .expect("JSON");
    assert_eq!(split["test"].as_array().map(Vec::len), Some(6));
}

/// Removes values that depend on the training part of a model.
fn without_skill(report: &mut Value) {
    let metrics = report["metrics"].as_object_mut().expect("an object");
    assert!(
        metrics.remove("skill").is_some(),
        "skill comes with every prediction"
    );
    for channels in metrics.values_mut() {
        for score in channels.as_object_mut().expect("an object").values_mut() {
            let score = score.as_object_mut().expect("an object");
            score.remove("standing");
            score.remove("bounded_share");
            score.remove("of_constant");
        }
    }
}

#[test]
fn the_bytes_of_a_result_do_not_depend_on_the_number_of_jobs() {
    let bench = Bench::imported();
    let of = |jobs: u32| {
        bench.ok(&format!(
            "evaluate data --model ridge --split by-point --format json -q --jobs {jobs}"
        ))
    };
    assert_eq!(of(1), of(2));
    assert_eq!(of(1), of(5));
}

#[test]
fn an_evaluation_that_reads_no_frame_decodes_none() {
    let bench = Bench::imported();
    let report = bench.json("evaluate data --model baseline --split by-point");
    assert_eq!(report["provenance"]["frames_decoded"], 0);
    let plan = bench.ok("evaluate data --model baseline --split by-point --explain");
    assert!(
        plan.contains("field:frame") && plan.contains("no requested result reads it"),
        "{plan}"
    );
    let plan = bench.ok("evaluate data --model ridge --split by-point --explain");
    assert!(
        plan.contains("decode   6 frames of the part `test`"),
        "{plan}"
    );
    // Damaged pictures do not affect a model that reads none.
    std::fs::remove_dir_all(bench.path("data/frames")).expect("there");
    bench.ok("evaluate data --model baseline --split by-point");
    bench.refused("evaluate data --model ridge --split by-point", 3, "frames/");
}

#[test]
fn every_form_of_a_result_holds_every_score() {
    let bench = Bench::imported();
    for (format, sign) in [
        ("text", "95 % interval"),
        ("json", "\"ci95\""),
        ("csv", "ci95_low"),
        ("md", "| mae ↓ |"),
        ("tex --table all", "\\toprule"),
    ] {
        let out = bench.ok(&format!(
            "evaluate data --model ridge --split by-point --format {format} -q"
        ));
        assert!(out.contains(sign), "{format}:\n{out}");
        assert!(
            ["mae", "rmse", "bias", "smape"]
                .iter()
                .all(|metric| out.to_lowercase().contains(metric)),
            "{format}:\n{out}"
        );
    }
}

#[test]
fn nothing_is_written_over_without_force() {
    let bench = Bench::imported();
    bench.ok("fit data --model ridge --out model -q");
    bench.refused(
        "fit data --model ridge --out model",
        3,
        "model exists already; --force replaces it",
    );
    bench.refused(
        "import lab --map map.toml --out data",
        3,
        "data exists already; --force replaces it",
    );
    bench.refused(
        "evaluate data --with model --out map.toml",
        3,
        "map.toml exists already",
    );
    bench.ok("fit data --model ridge --out model --force -q");
    let before = bench.ok("import lab --map map.toml --out data --force");
    assert!(before.contains("60 read, 60 kept"));
    assert_eq!(
        leftovers(
            &bench.path("."),
            &["lab", "map.toml", "drawn", "data", "model", "user-cache"]
        ),
        Vec::<String>::new()
    );
}

#[test]
fn explaining_an_import_writes_nothing() {
    let bench = Bench::new();
    bench.lab();
    let plan = bench.ok("import lab --map map.toml --explain");
    assert!(
        plan.contains("channel  Fz [N] = `force_N` [N]: 60 values, 0 absent"),
        "{plan}"
    );
    assert_eq!(
        leftovers(&bench.path("."), &["lab", "map.toml", "drawn"]),
        Vec::<String>::new()
    );
}

#[test]
fn a_model_is_scored_on_all_of_another_dataset_and_on_the_test_part_of_its_own() {
    let bench = Bench::imported();
    bench.record("other", 32);
    bench.ok("fit data --model ridge --out model -q");
    let own = bench.json("evaluate data --with model");
    assert_eq!(
        (
            own["provenance"]["part"].as_str(),
            own["metrics"]["mae"]["Fz"]["n"].as_u64()
        ),
        (Some("test"), Some(6))
    );
    let other = bench.json("evaluate other --with model");
    assert_eq!(
        (
            other["provenance"]["part"].as_str(),
            other["metrics"]["mae"]["Fz"]["n"].as_u64()
        ),
        (Some("all"), Some(60))
    );
    assert_eq!(other["subject"]["source"], "synthetic");
    bench.refused(
        "evaluate other --with model --part test",
        2,
        "fitted on another dataset",
    );
}

#[test]
fn where_every_sample_is_its_own_point_by_point_is_reported_as_equal_to_random() {
    let bench = Bench::new();
    bench.lab();
    bench.write(
        "map.toml",
        &crate::support::MAP.replace("point_id = \"point\"", "point_id = \"sample\""),
    );
    bench.ok("import lab --map map.toml --out data");
    let by_point = bench.json("evaluate data --model ridge --split by-point");
    let random = bench.json("evaluate data --model ridge --split random");
    assert_eq!(by_point["metrics"], random["metrics"]);
    let notes = by_point["provenance"]["notes"].to_string();
    assert!(notes.contains("random"), "{notes}");
}

#[test]
fn completions_are_printed_for_every_shell() {
    let bench = Bench::new();
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        assert!(
            bench.ok(&format!("completions {shell}")).contains("taceva"),
            "{shell}"
        );
    }
}

#[test]
fn help_teaches_every_command() {
    let bench = Bench::new();
    let help = bench.ok("--help");
    for command in [
        "import",
        "check",
        "fit",
        "evaluate",
        "predict",
        "score",
        "completions",
    ] {
        assert!(help.contains(command), "{command}");
        assert!(
            bench.ok(&format!("{command} --help")).contains("Usage"),
            "{command}"
        );
    }
}
