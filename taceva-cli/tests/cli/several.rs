//! Several recordings as one: refusals, division, clusters of intervals, and scores of each recording and of all.

use std::fs;

use crate::support::Bench;
use serde_json::Value;

const FIVE: [&str; 5] = ["monday", "tuesday", "wednesday", "thursday", "friday"];

/// Test folder with five recordings of one sensor, each with the same names of ten points, and their names.
fn week() -> (Bench, String) {
    let bench = Bench::new();
    for (name, noise) in FIVE.into_iter().zip(0..) {
        bench.record_with_noise(name, 24, noise);
    }
    (bench, FIVE.join(" "))
}

fn notes(report: &Value) -> String {
    report["provenance"]["notes"].to_string()
}

#[test]
fn a_single_recording_has_no_key_of_several() {
    let bench = Bench::new();
    bench.record("monday", 24);
    let report = bench
        .json("evaluate monday --model ridge --split by-point --set size=8 --metrics accuracy");
    assert_eq!(report["schema"], "taceva.evaluation/1.0");
    assert_eq!(report["by_recording"], Value::Null);
    assert_eq!(report["provenance"]["recordings"], Value::Null);
}

#[test]
fn points_of_one_name_stay_apart_and_each_recording_is_divided_as_it_would_be_alone() {
    let (bench, _) = week();
    let both = bench.json(
        "evaluate monday tuesday --model ridge --set size=8 --metrics accuracy --split-out both.json",
    );
    crate::schema::check("evaluation", &both);
    assert_eq!(both["schema"], "taceva.evaluation/1.0");
    bench.ok("fit tuesday --model ridge --set size=8 --split-out one.json --out one.model -q");
    let read = |name: &str| -> Value {
        let text = fs::read_to_string(bench.path(name)).expect("written");
        serde_json::from_str(&text).expect("JSON")
    };
    let (both_parts, one) = (read("both.json"), read("one.json"));
    for part in ["train", "validation", "test"] {
        let of_tuesday: Vec<String> = both_parts[part]
            .as_array()
            .expect("ids")
            .iter()
            .filter_map(|id| Some(id.as_str()?.strip_prefix("tuesday/")?.to_owned()))
            .collect();
        assert_eq!(serde_json::json!(of_tuesday), one[part], "{part}");
    }
    // Ten points called p0 to p9 in each: twenty in all, two of them in the test part.
    let notes = notes(&both);
    assert!(
        notes.contains("2 contact points of 2 recordings"),
        "{notes}"
    );
    let scored: Vec<u64> = both["by_recording"]
        .as_array()
        .expect("two")
        .iter()
        .map(|own| own["metrics"]["mae"]["Fz"]["n"].as_u64().expect("n"))
        .collect();
    assert_eq!(scored, [6, 6]);
    assert_eq!(both["metrics"]["mae"]["Fz"]["n"], 12);
}

#[test]
fn scores_of_each_recording_stand_beside_those_of_all_in_every_form() {
    let (bench, _) = week();
    let command = "evaluate monday tuesday --model ridge --set size=8 --metrics accuracy -q";
    let text = bench.ok(command);
    let has_line = |words: &str| {
        let mut lines = text.lines();
        lines.any(|line| line.split_whitespace().eq(words.split(' ')))
    };
    assert!(has_line("recording samples scored digest"), "{text}");
    assert!(has_line("metric channel all monday tuesday unit"), "{text}");
    let csv = bench.ok(&format!("{command} --format csv"));
    let head = csv.lines().next().expect("a header");
    assert!(head.ends_with("recording,recording_digest"), "{head}");
    let report =
        bench.json("evaluate monday tuesday --model ridge --set size=8 --metrics accuracy");
    let digest = report["by_recording"][1]["digest"]
        .as_str()
        .expect("a digest");
    assert!(
        csv.lines()
            .any(|line| line.ends_with(&format!("tuesday,{digest}")))
    );
    assert!(text.contains(digest));
    let page = "evaluate monday tuesday --model ridge --set size=8 --html page.html -q";
    bench.ok(page);
    let page = fs::read_to_string(bench.path("page.html")).expect("written");
    assert!(
        page.contains(digest),
        "the page names the recording by its digest"
    );
    let md = bench.ok(&format!("{command} --format md"));
    assert!(md.contains("Recordings: monday"), "{md}");
}

#[test]
fn intervals_are_by_recording_where_there_are_five_with_scored_samples() {
    let (bench, all) = week();
    let report = bench.json(&format!("evaluate {all} --model ridge --set size=8"));
    let mae = &report["metrics"]["mae"]["Fz"];
    assert_eq!(mae["clusters"], 5, "{mae}");
    let method = mae["method"].as_str().expect("a method");
    assert!(
        method.starts_with("jackknife by recording, G=5"),
        "{method}"
    );
    let notes = notes(&report);
    assert!(notes.contains("5 are few"), "{notes}");
    let own = &report["by_recording"][0]["metrics"]["mae"]["Fz"];
    assert_ne!(own["clusters"], 5, "{own}");
    bench.ok(&format!(
        "evaluate {all} --model ridge --set size=8 --metrics accuracy --state-out a.state -q"
    ));
    let merged = bench.json("merge a.state");
    assert_eq!(merged["metrics"]["mae"]["Fz"], *mae);
}

#[test]
fn leaving_one_recording_out_tests_every_sample_by_a_model_that_has_not_seen_its_recording() {
    let (bench, all) = week();
    let command = format!(
        "evaluate {all} --model ridge --set size=8 --set strength=1 --metrics accuracy --split leave-one-recording-out"
    );
    let report = bench.json(&command);
    let ran = bench.run(&command);
    let named = "fit ridge, fold 5 of 5 without friday";
    assert!(ran.err.contains(named), "{}", ran.err);
    crate::schema::check("evaluation", &report);
    assert_eq!(report["metrics"]["mae"]["Fz"]["n"], 300);
    assert_eq!(report["provenance"]["samples"]["test"], 300);
    // The fold that tests friday, named by hand.
    let by_hand = bench.json(&format!(
        "evaluate {all} --model ridge --set size=8 --set strength=1 --metrics mae --split by-recording=train:monday,tuesday,wednesday,thursday;test:friday"
    ));
    assert_eq!(by_hand["metrics"]["mae"]["Fz"]["n"], 60);
    let fold = &report["by_recording"][4]["metrics"]["mae"]["Fz"];
    assert_eq!(fold["n"], 60);
    bench.refused(
        &format!("{command} --part train"),
        2,
        "leave-one-recording-out scores every sample",
    );
    bench.refused(
        &format!("fit {all} --model ridge --split leave-one-recording-out --out m.model"),
        2,
        "fits a model for each fold",
    );
    bench.refused(
        "evaluate monday --model ridge --split leave-one-recording-out",
        3,
        "there is one recording",
    );
    let plan = bench.ok(&format!("{command} --explain"));
    assert!(plan.contains("5 models"), "{plan}");
}

#[test]
fn recordings_that_are_the_same_or_differ_in_what_they_are_of_are_refused_with_the_names_of_both() {
    let (bench, _) = week();
    let evaluate = |names: &str| format!("evaluate {names} --model ridge");
    bench.refused(
        &evaluate("monday ./tuesday/../monday"),
        3,
        "both paths name one folder",
    );
    copy(&bench, "monday", "copy");
    bench.refused(
        &evaluate("monday tuesday copy"),
        3,
        "monday and copy cannot be joined into one recording: both have the same 60 samples",
    );
    bench.record("small", 16);
    bench.refused(
        &evaluate("monday small"),
        3,
        "monday and small cannot be joined into one recording: `frames` is 24×24 gray8 in the first recording and 16×16 gray8 in the second",
    );
    for (key, from, to) in [
        ("sensor.model", "model = \"drawn\"", "model = \"other\""),
        ("sensor.opaque", "opaque = true", "opaque = false"),
        ("channels", "unit = \"N\"", "unit = \"mm\""),
    ] {
        let name = key.replace('.', "-");
        copy(&bench, "tuesday", &name);
        let header = bench.path(&name).join("dataset.toml");
        let text = fs::read_to_string(&header).expect("a header");
        assert!(text.contains(from), "{text}");
        fs::write(&header, text.replace(from, to)).expect("written");
        let resealed = bench.run(&format!("reseal {name} --reason other"));
        // Units are part of the digest of the table, so such a header is refused before the comparison.
        if resealed.code == 0 {
            bench.refused(
                &evaluate(&format!("monday {name}")),
                3,
                &format!("`{key}` is"),
            );
        }
    }
    let check = bench.run("check monday tuesday");
    assert!(
        check.out.contains("monday\n") && check.out.contains("tuesday\n"),
        "{}",
        check.out
    );
    let refused = bench.run("check monday small");
    assert!(refused.err.contains("`frames` is"), "{}", refused.err);
}

#[test]
fn a_model_of_several_is_scored_on_their_test_part_on_others_whole_and_on_some_of_them_never() {
    let (bench, _) = week();
    bench.ok("fit monday tuesday --model ridge --set size=8 --out both.model -q");
    let own = bench.json("evaluate monday tuesday --with both.model --metrics mae");
    assert_eq!(own["provenance"]["part"], "test");
    let fitted = bench.json("evaluate monday tuesday --model ridge --set size=8 --metrics mae");
    assert_eq!(own["metrics"], fitted["metrics"]);
    let others = bench.json("evaluate wednesday thursday --with both.model --metrics mae");
    assert_eq!(others["provenance"]["part"], "all");
    for some in ["monday", "tuesday monday", "monday wednesday"] {
        bench.refused(
            &format!("evaluate {some} --with both.model"),
            2,
            "the model was fitted on this recording and others, 2 recordings together",
        );
    }
    bench.ok("predict monday tuesday --with both.model --out pred.csv --truth-out truth.csv -q");
    let predicted = fs::read_to_string(bench.path("pred.csv")).expect("written");
    assert!(
        predicted
            .lines()
            .nth(1)
            .expect("a row")
            .starts_with("monday/monday-")
    );
}

/// Copies the dataset `name` to `to`, byte for byte.
fn copy(bench: &Bench, name: &str, to: &str) {
    let copied = std::process::Command::new("cp")
        .arg("-r")
        .args([bench.path(name), bench.path(to)])
        .status();
    assert!(copied.expect("cp runs").success());
}
